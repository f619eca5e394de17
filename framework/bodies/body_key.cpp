#include "framework/bodies/body_key.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <string_view>

#include "files/files.h"
#include "framework/bodies/elastic_parts.h"
#include "framework/common/value_writer.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;

class Writer : public ValueWriter<Writer> {
 public:
  using ValueWriter::add;
  void bytes(std::string_view some) { out_ += some; }
  std::string take() { return std::move(out_); }

  void add(const ScenePoint& p) {
    const auto& [name, at, angle, place, hole, coupling] = p;
    add(name, at, angle, hole, coupling);
  }

  void add(const SceneLump& l) {
    const auto& [at, mass, inertia, place] = l;
    add(at, mass, inertia);
  }

  void add(const Isotropic& m) {
    const auto& [young, poisson] = m;
    add(young, poisson);
  }
  void add(const Orthotropic& m) {
    const auto& [young_1, young_2, poisson_12, shear_12, angle, young_3, poisson_13, poisson_23] = m;
    add(young_1, young_2, poisson_12, shear_12, angle, young_3, poisson_13, poisson_23);
  }
  void add(const Material& m) {
    const auto& [elastic, density] = m;
    add(elastic, density);
  }
  void add(const SceneMaterial& m) {
    const auto& [name, material, place] = m;
    add(material);
  }

  void add(const RectangleSection& s) {
    const auto& [height, width] = s;
    add(height, width);
  }
  void add(const CircleSection& s) {
    const auto& [diameter] = s;
    add(diameter);
  }
  void add(const TubeSection& s) {
    const auto& [outer, inner] = s;
    add(outer, inner);
  }
  void add(const ISection& s) {
    const auto& [height, width, web, flange] = s;
    add(height, width, web, flange);
  }
  void add(const GivenSection& s) {
    const auto& [area, second_moment, fibre, shear_factor] = s;
    add(area, second_moment, fibre, shear_factor);
  }
  void add(const SceneBeam& b) {
    const auto& [through, section, taper_to, theory, shear, rotary, bar, material, mass, elements, pieces] = b;
    add(through, section, taper_to, theory, shear, rotary, bar, material, mass, elements, pieces);
  }

  void add(const Eye& e) {
    const auto& [bore, outer] = e;
    add(bore, outer);
  }
  void add(const StraightBar& l) {
    const auto& [length, width] = l;
    add(length, width);
  }
  void add(const EyeBar& l) {
    const auto& [length, width, first, second] = l;
    add(length, width, first, second);
  }
  void add(const TaperedBar& l) {
    const auto& [length, width_left, width_right] = l;
    add(length, width_left, width_right);
  }
  void add(const Triangle& l) {
    const auto& [center, eye] = l;
    for (const Eigen::Vector2d& c : center) add(c);
    for (const Eye& e : eye) add(e);
  }
  void add(const Disc& l) {
    const auto& [diameter, bore] = l;
    add(diameter, bore);
  }
  void add(const SceneFile& f) {
    const auto& [path, scale, unit_given] = f;
    add(path, scale, unit_given);
  }
  void add(const SceneGrid& g) {
    const auto& [corners, nx, ny] = g;
    add(corners, nx, ny);
  }
  void add(const ScenePlate& p) {
    const auto& [shape, thickness, state, state_given, material, mass, element, size, hole_size] = p;
    add(shape, thickness, state, state_given, material, mass, element, size, hole_size);
  }

  void add(const SceneKeep& k) {
    const auto& [automatic, count, below, effective_mass] = k;
    add(automatic, count, below, effective_mass);
  }
  void add(const SceneModes& m) {
    const auto& [frame, a, b, method, keep, massless, place] = m;
    add(frame, a, b, method, keep, massless);
  }

 private:
  std::string out_;
};

/// Words, or parts of words, with which a Gmsh script refers to outside data: Include, ListFromFile, GetEnv, SystemCall, Rand, OnelabRun, …
constexpr std::string_view outward[]{"Include", "Merge", "Open",    "File",       "Env",    "System",  "Rand",   "nelab",     "ONELAB",
                                     "Plugin",  "Today", "Cpu",     "Memory",     "Exists", "Define",  "Get",    "SetNumber", "SetString",
                                     "Current", "Path",  "DirName", "Executable", "MPI",    "General", "Solver", "External"};

/// Whether a drawing may depend on more than its own text. If in doubt true, which only costs another meshing.
bool looks_beyond(const std::string& kind, const std::string& text) {
  const auto has = [&](std::string_view word) { return text.find(word) != std::string::npos; };
  if (kind == ".geo") return std::any_of(std::begin(outward), std::end(outward), has);
  if (kind == ".step" || kind == ".stp") return has("DOCUMENT") || has("EXTERNAL");
  if (kind == ".inp") {
    constexpr std::string_view word = "*INCLUDE";  // in upper or lower case
    const auto alike = [](unsigned char a, unsigned char b) { return std::toupper(a) == b; };
    return std::search(text.begin(), text.end(), word.begin(), word.end(), alike) != text.end();
  }
  return kind != ".msh" && kind != ".brep";
}

std::optional<std::string> contents(const Scene& scene, const SceneFile& file) {
  constexpr std::size_t most_bytes = std::size_t{1} << 30;
  std::string text;
  try {
    const fs::path path = contained_file(file.path, fs::path(scene.file).parent_path());
    text = read_file(path, most_bytes);
  } catch (const FileRejected&) {
    return {};  // meshing it reports the error
  }
  if (text.empty() || looks_beyond(kind_of(file.path), text)) return {};
  return text;
}

}  // namespace

std::optional<std::string> elements_key(const Scene& scene, const SceneBody& body) {
  const auto& [name, mass, inertia, center, points, profiles, elastic, at, angle, place, drawn_at, drawn_angle, colour] = body;
  const auto& [shape, lumped, lumps, supports, modes, damping, stiffening] = *elastic;
  Writer key;
  key.add(points, shape, lumped, lumps);
  if (const auto* plate = std::get_if<ScenePlate>(&shape))
    if (const auto* file = std::get_if<SceneFile>(&plate->shape)) {
      const std::optional<std::string> text = contents(scene, *file);
      if (!text) return {};
      key.add(*text);
    }
  return key.take();
}

std::string reduction_key(const SceneElastic& body, const std::vector<int>& ports, const std::vector<int>& massless,
                          const std::optional<int>& chosen) {
  const auto& [shape, lumped, lumps, supports, modes, damping, stiffening] = body;
  Writer key;
  key.add(modes, stiffening, ports, massless, chosen);
  return key.take();
}

}  // namespace pintle
