#include "framework/drawing/vtk.h"

#include <array>
#include <cassert>
#include <cstdio>
#include <system_error>

#include "framework/common/file.h"
#include "framework/common/file_names.h"
#include "framework/common/text.h"
#include "framework/drawing/vtk_encoder.h"
#include "meshes/module.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;

const VtkEncoder& encoder() {
  static const VtkEncoder& loaded = module_table<VtkEncoder>("vtk");
  return loaded;
}

void write_vtu(const fs::path& path, const std::string& text) {
  if (text.empty()) throw FileError(path, "VTK could not encode it, for which it needs memory");
  write_text(path, text);
}

}  // namespace

void write_grid(const fs::path& path, const Eigen::Matrix2Xd& at, const std::vector<Cells>& cells, const std::vector<Field>& on_points,
                const std::vector<Field>& on_cells, double t) {
  write_vtu(path, encoder().grid(at, cells, on_points, on_cells, t));
}

void write_collection(const fs::path& path, const std::vector<CollectedFile>& files) {
  std::string pvd = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
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
  FileNames names;

  void keep(const DrawnBody& body) { kept.push_back({body.name, names.add(body.name, "body"), {}}); }
};

FrameWriter::FrameWriter(fs::path directory) : directory_(std::move(directory)), bodies_(std::make_unique<Bodies>()) {
  std::error_code error;
  const fs::path frames = directory_ / "frames";
  fs::create_directories(frames, error);
  if (error) throw FileError(frames, error.value(), "cannot be made");
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

void FrameWriter::finish() { write_collection(directory_ / "mechanism.pvd", files_); }

}  // namespace pintle
