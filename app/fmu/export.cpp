#include "app/fmu/export.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <map>

#include "app/fmu/archive.h"
#include "app/fmu/model_description.h"
#include "files/files.h"
#include "files/noted.h"
#include "framework/bodies/segments.h"
#include "framework/build/build.h"
#include "framework/common/sha256.h"
#include "framework/configuration/assemble.h"
#include "meshes/module.h"

namespace pintle::app {

namespace {

namespace fs = std::filesystem;

#if defined(__aarch64__)
constexpr const char* platform = "aarch64-linux";
#else
constexpr const char* platform = "x86_64-linux";
#endif

constexpr const char* licence =
    "The shared library of this unit is Pintle, free software under the GNU General Public License, version 3 or any later\n"
    "version: whoever receives the unit is entitled to the program's source. The scene in resources/ belongs to its author.\n";

/// The name of the scene's file without its endings.
std::string name_of(const fs::path& scene) {
  return (scene.stem().has_extension() ? scene.stem().stem() : scene.stem()).string();  // NAME.pintle.yaml
}

/// Converts it to an identifier of C.
std::string identifier_of(const fs::path& scene) {
  std::string out = name_of(scene);
  for (char& c : out)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return out.empty() || std::isdigit(static_cast<unsigned char>(out[0])) ? "scene_" + out : out;
}

/// Contents of the scene's files, by their names in its folder.
std::map<std::string, std::string> scene_files(const fs::path& scene, const std::vector<fs::path>& noted) {
  const fs::path folder = fs::absolute(scene).lexically_normal().parent_path();
  std::map<std::string, std::string> out;
  for (const fs::path& path : noted) {
    std::error_code error;
    if (!fs::is_regular_file(path, error)) continue;
    const fs::path name = fs::absolute(path).lexically_normal().lexically_relative(folder);
    if (name.empty() || *name.begin() == "..")
      throw SceneError(path.string() + ": lies outside the folder of the scene, " + folder.string() +
                       ", but a unit can contain files of this folder only; copy it there and correct its path in the scene");
    if (!out.contains(name.generic_string())) out[name.generic_string()] = read_file(path, std::numeric_limits<std::size_t>::max());
  }
  return out;
}

std::string token_of(const fmi::FmuContents& contents, const std::map<std::string, std::string>& files) {
  Sha256 sum;
  sum.add(fmi::text_of(contents));
  for (const auto& [name, content] : files) sum.add(name), sum.add(std::string_view("\0", 1)), sum.add(sha256(content));
  return sum.hex();
}

}  // namespace

ExportedFmu export_fmu(const FmuOrder& order) {
  ExportedFmu out;
  std::map<std::string, std::string> files;
  {
    FilesNoted noted;
    Scene scene = read_scene(order.scene, order.set);
    require_run(scene);
    scene = with_pieces(std::move(scene));
    const Model model = build(scene);
    assemble(scene, model);
    out.warnings = model.warnings;
    out.contents = {scene.title.empty() ? order.scene.stem().string() : scene.title,
                    order.scene.filename().string(),
                    "",
                    order.set,
                    fmi::variables_of(scene, model, order.inputs, order.outputs),
                    scene.run.until,
                    scene.run.tolerance,
                    scene.output.every > 0 ? scene.output.every : scene.run.until / 1000};
    const std::vector<fs::path>& paths = noted.paths();
    files = scene_files(order.scene, paths);
  }
  out.contents.token = token_of(out.contents, files);
  const std::string identifier = identifier_of(order.scene);
  out.file = order.out.empty() ? fs::path(name_of(order.scene) + ".fmu") : order.out;
  const std::string library = read_file(file_beside_modules("libpintle_fmu.so"), std::numeric_limits<std::size_t>::max());
  ZipFile zip(out.file);
  zip.add("modelDescription.xml", model_description(out.contents, identifier));
  zip.add("binaries/" + std::string(platform) + "/" + identifier + ".so", library, true);
  zip.add(std::string("resources/") + fmi::contents_file, fmi::text_of(out.contents));
  out.files = {out.contents.scene};
  for (const auto& [name, content] : files) {
    zip.add("resources/scene/" + name, content);
    if (name != out.contents.scene) out.files.push_back(name);
  }
  zip.add("documentation/index.html", variables_page(out.contents));
  zip.add("documentation/licenses/license.txt", licence);
  zip.commit();
  return out;
}

}  // namespace pintle::app
