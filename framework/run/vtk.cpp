#include "framework/run/vtk.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <cstdio>
#include <stdexcept>
#include <system_error>

#include "framework/run/text.h"
#include "framework/run/vtk_encoder.h"
#include "meshes/module.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw std::runtime_error(path.string() + ": cannot be written (" + why + ")");
}

const VtkEncoder& encoder() {
  static const VtkEncoder& loaded = module_table<VtkEncoder>("vtk");
  return loaded;
}

void write_vtu(const fs::path& path, const std::string& text) {
  if (text.empty()) fail(path, "VTK could not encode it");
  write_text(path, text);
}

/// What is left of a name in that of a file: other signs mean something to shells, XML or file
/// systems.
std::string file_stem(const std::string& name) {
  std::string stem;
  for (const char c : name) {
    const bool kept = c == '-' || c == '_' || (c == '.' && !stem.empty()) ||
                      (static_cast<unsigned char>(c) < 128 && std::isalnum(c));
    stem += kept ? c : '_';
  }
  return stem.empty() ? "body" : stem;
}

bool same_but_for_case(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return std::tolower(x) == std::tolower(y); });
}

}  // namespace

void write_grid(const fs::path& path, const Eigen::Matrix2Xd& at, const std::vector<Cells>& cells,
                const std::vector<Field>& on_points, const std::vector<Field>& on_cells, double t) {
  write_vtu(path, encoder().grid(at, cells, on_points, on_cells, t));
}

void write_collection(const fs::path& path, const std::vector<CollectedFile>& files) {
  std::string pvd =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (const CollectedFile& f : files) {
    pvd += "    <DataSet timestep=\"";
    append_number(pvd, f.t);
    pvd += "\" part=\"" + std::to_string(f.part) + "\" file=\"" + f.file + "\"/>\n";
  }
  pvd += "  </Collection>\n</VTKFile>\n";
  write_text(path, pvd);
}

struct FrameWriter::Bodies {
  struct Kept {
    std::string name, stem;
    std::shared_ptr<void> cells;  ///< as VTK keeps them, the same in each frame
  };
  std::vector<Kept> kept;

  void keep(const DrawnBody& body) {
    Kept k{body.name, file_stem(body.name), {}};
    const auto taken = [&] {
      return std::any_of(kept.begin(), kept.end(),
                         [&](const Kept& other) { return same_but_for_case(k.stem, other.stem); });
    };
    for (int i = 2; taken(); ++i) k.stem = file_stem(body.name) + "_" + std::to_string(i);
    kept.push_back(std::move(k));
  }
};

FrameWriter::FrameWriter(fs::path directory)
    : directory_(std::move(directory)), bodies_(std::make_unique<Bodies>()) {
  std::error_code error;
  const fs::path frames = directory_ / "frames";
  fs::create_directories(frames, error);
  if (error) fail(frames, error.message());
}

FrameWriter::~FrameWriter() = default;

void FrameWriter::add(const Drawing& drawing) {
  std::array<char, 16> number_text;
  std::snprintf(number_text.data(), number_text.size(), "%05d.vtu", frames_++);
  const std::string ending = number_text.data();
  write_vtu(directory_ / "frames" / ending, encoder().lines(drawing));
  files_.push_back({drawing.t, "frames/" + ending});

  for (std::size_t b = 0; b < drawing.bodies.size(); ++b) {
    const DrawnBody& body = drawing.bodies[b];
    if (b == bodies_->kept.size()) bodies_->keep(body);
    Bodies::Kept& kept = bodies_->kept[b];
    assert(kept.name == body.name);
    const std::string file = kept.stem + "_" + ending;
    write_vtu(directory_ / "frames" / file, encoder().body(body, drawing.t, drawing.deformation, kept.cells));
    files_.push_back({drawing.t, "frames/" + file, static_cast<int>(b) + 1});
  }
}

void FrameWriter::finish() {
  write_collection(directory_ / "mechanism.pvd", files_);
}

}  // namespace pintle
