#include "framework/drawing/vtk.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

#include "framework/common/file.h"
#include "framework/common/file_names.h"
#include "framework/common/text.h"
#include "framework/drawing/frame_text.h"
#include "framework/drawing/palette.h"
#include "framework/drawing/paraview_macro.h"
#include "framework/drawing/vtk_encoder.h"
#include "meshes/module.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;

const VtkEncoder& encoder() {
  static const VtkEncoder& loaded = module_table<VtkEncoder>("vtk");
  return loaded;
}

}  // namespace

void write_grid(const fs::path& path, const Eigen::Matrix2Xd& at, const std::vector<Cells>& cells, const std::vector<Field>& on_points,
                const std::vector<Field>& on_cells, double t) {
  const std::string text = encoder().grid(at, cells, on_points, on_cells, t);
  if (text.empty()) throw FileError(path, "VTK could not encode it; probably there was not enough memory");
  write_text(path, text);
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

namespace {

/// As a list in Python, of the channels from 0 to 1.
template <std::size_t n>
std::string python(const std::array<Rgb, n>& colours) {
  std::string out;
  for (const Rgb& rgb : colours) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "(%.3f, %.3f, %.3f)", rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
    out += (out.empty() ? "[" : ", ") + std::string(text.data());
  }
  return out + "]";
}

std::string python(const std::array<const char*, 4>& names) {
  std::string out;
  for (const char* const name : names) out += (out.empty() ? "[\"" : ", \"") + std::string(name) + "\"";
  return out + "]";
}

std::string paraview_script() {
  std::string out = paraview_macro;
  const std::pair<std::string, std::string> written[] = {
      {"BODY_PALETTE", python(body_palette)}, {"ARROW_PALETTE", python(arrow_palette)}, {"GIVERS", python(giver_names)}};
  for (const auto& [word, text] : written) out.replace(out.find(word), word.size(), text);
  return out;
}

}  // namespace

struct FrameWriter::Bodies {
  struct Kept {
    std::string name, stem;
    PackedCells cells;  ///< the same in each frame
  };
  std::vector<Kept> kept;
  FileNames names;

  void keep(const DrawnBody& body) { kept.push_back({body.name, names.add(body.name, "body"), PackedCells(body.cells)}); }
};

struct FrameWriter::Paths {
  std::vector<std::string> names, contacts;            ///< of followed points, of contacts
  std::vector<std::vector<Eigen::Vector2d>> followed;  ///< one path each
  std::vector<std::vector<Eigen::Vector2d>> touching;  ///< likewise
  std::vector<double> t;                               ///< of the frames [s]

  void add(const Drawing& drawing) {
    t.push_back(drawing.t);
    lead_on(drawing.followed, names, followed);
    lead_on(drawing.touching, contacts, touching);
  }
  Drawing drawing() const {
    Drawing out;
    out.owners = names;
    for (std::size_t k = 0; k < followed.size(); ++k) out.lines.push_back({Part::trace, static_cast<int>(k), false, followed[k]});
    return out;
  }
  /// Position of a contact, interpolated linearly between two frames.
  Eigen::Vector2d place(const DrawnImpact& impact) const {
    const auto& path = touching[static_cast<std::size_t>(impact.place)];
    const auto after = static_cast<std::size_t>(std::ranges::lower_bound(t, impact.t) - t.begin());
    if (after == 0) return path.front();
    if (after == t.size()) return path.back();
    const double share = (impact.t - t[after - 1]) / (t[after] - t[after - 1]);
    return path[after - 1] + share * (path[after] - path[after - 1]);
  }

 private:
  static void lead_on(const std::vector<FollowedPoint>& now, std::vector<std::string>& names,
                      std::vector<std::vector<Eigen::Vector2d>>& paths) {
    paths.resize(now.size());
    names.clear();
    for (std::size_t k = 0; k < now.size(); ++k) paths[k].push_back(now[k].at), names.push_back(now[k].name);
  }
};

FrameWriter::FrameWriter(fs::path directory)
    : directory_(std::move(directory)), bodies_(std::make_unique<Bodies>()), paths_(std::make_unique<Paths>()) {
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
  write_text(directory_ / "frames" / ending, lines_text(drawing));
  files_.push_back({drawing.t, "frames/" + ending});
  paths_->add(drawing);

  for (std::size_t b = 0; b < drawing.bodies.size(); ++b) {
    const DrawnBody& body = drawing.bodies[b];
    if (b == bodies_->kept.size()) bodies_->keep(body);
    const Bodies::Kept& kept = bodies_->kept[b];
    assert(kept.name == body.name);
    const std::string file = kept.stem + "_" + ending;
    write_text(directory_ / "frames" / file, body_text(body, drawing.t, drawing.deformation, kept.cells));
    files_.push_back({drawing.t, "frames/" + file, static_cast<int>(b) + 1});
  }
}

void FrameWriter::write_whole_run(const std::string& name, const std::string& vtu) {
  const std::string file = "frames/" + bodies_->names.add(name, name) + ".vtu";
  write_text(directory_ / file, vtu);
  int part = 0;
  for (const CollectedFile& f : files_) part = std::max(part, f.part + 1);
  for (const double t : paths_->t) files_.push_back({t, file, part});
}

void FrameWriter::finish(const std::vector<DrawnImpact>& impacts) {
  if (!paths_->followed.empty()) write_whole_run("paths", lines_text(paths_->drawing()));
  if (!impacts.empty() && !paths_->touching.empty()) {
    Eigen::Matrix2Xd at(2, static_cast<Eigen::Index>(impacts.size()));
    std::vector<std::string> names;
    for (std::size_t k = 0; k < impacts.size(); ++k) {
      at.col(static_cast<Eigen::Index>(k)) = paths_->place(impacts[k]);
      names.push_back(paths_->contacts[static_cast<std::size_t>(impacts[k].place)]);
    }
    write_whole_run("impacts", impacts_text(at, impacts, names));
  }
  std::ranges::stable_sort(files_, {}, &CollectedFile::t);
  write_collection(directory_ / "mechanism.pvd", files_);
  write_text(directory_ / "mechanism.py", paraview_script());
}

}  // namespace pintle
