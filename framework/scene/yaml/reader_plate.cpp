#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>

#include "files/files.h"
#include "framework/common/file_names.h"
#include "framework/common/nearest.h"
#include "framework/scene/yaml/reader_parts.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
constexpr const char* plate_keys = "bodies.*.plate";

const std::vector<std::string> common{"thickness", "plane", "element", "material", "young", "poisson", "orthotropic", "density", "mass"};

std::vector<std::string> with(std::initializer_list<const char*> more) {
  std::vector<std::string> all = common;
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

const std::array<KindKeys, 3> plate_kinds{
    {{"file", with({"size", "hole size", "scale", "unit"})}, {"link", with({"size", "hole size"})}, {"grid", with({})}}};

const std::array<KindKeys, 5> link_kinds{{{"bar", {}}, {"eye bar", {}}, {"tapered bar", {}}, {"triangle", {}}, {"disc", {}}}};

// A hole and its surrounding outline.
std::pair<double, double> read_ring(const Node& node, std::string_view bore, std::string_view outer) {
  const Node inside = node.at(bore), outside = node.at(outer);
  const double b = read_size(inside), o = read_size(outside);
  if (b >= o)
    inside.fail(inside.shown() + " must be less than the " + std::string(outer) + (outer == "outer" ? " diameter " : " ") +
                outside.shown());
  return {b, o};
}

std::vector<Eye> read_eyes(const Node& node, std::size_t n, std::string_view path) {
  std::vector<Eye> eyes;
  for (const Node& item : node.items(n, (n == 2 ? "two" : "three") + std::string(" eyes, each {bore: 10 mm, outer: 20 mm}"))) {
    check_keys(item, path);
    const auto [bore, outer] = read_ring(item, "bore", "outer");
    eyes.push_back({bore, outer});
  }
  return eyes;
}

Link read_shape(const Node& node, std::size_t kind) {
  const std::string path = std::string(plate_keys) + ".link." + link_kinds[kind].kind;
  check_keys(node, path);
  if (kind == 0) return StraightBar{read_size(node.at("length")), read_size(node.at("width"))};
  if (kind == 1) {
    const auto eyes = read_eyes(node.at("eyes"), 2, path + ".eyes.*");
    return EyeBar{read_size(node.at("length")), read_size(node.at("width")), eyes[0], eyes[1]};
  }
  if (kind == 2) {
    const auto widths = read_quantities(node.at("widths"), 2, dimension::length, rule::positive, "two widths [left, right]");
    return TaperedBar{read_size(node.at("length")), widths[0], widths[1]};
  }
  if (kind == 4) {
    const auto [bore, diameter] = read_ring(node, "bore", "diameter");
    return Disc{diameter, bore};
  }
  Triangle triangle{};
  const auto centers = node.at("centers").items(3, "three places [[x, y], [x, y], [x, y]]");
  const auto eyes = read_eyes(node.at("eyes"), 3, path + ".eyes.*");
  for (std::size_t i = 0; i < 3; ++i) {
    const Pair at = centers[i].pair(dimension::length);
    triangle.center[i] = {at[0], at[1]};
    triangle.eye[i] = eyes[i];
  }
  return triangle;
}

Link read_link(const Node& node) {
  check_keys(node, std::string(plate_keys) + ".link");
  const std::size_t kind = which_kind(node, link_kinds);
  const Node shape = node.at(link_kinds[kind].kind);
  Link link = read_shape(shape, kind);
  try {
    validate(link);
  } catch (const std::invalid_argument& error) {
    shape.fail(error.what());
  }
  return link;
}

SceneGrid read_grid(const Node& node) {
  check_keys(node, std::string(plate_keys) + ".grid");
  SceneGrid grid{};
  const Node corners = node.at("corners");
  const auto four = corners.items(4, "four corners, counter-clockwise: [[x, y], …]");
  for (std::size_t i = 0; i < 4; ++i) grid.corners[i] = four[i].pair(dimension::length);
  for (std::size_t i = 0; i < 4; ++i) {
    const Pair &a = grid.corners[i], &b = grid.corners[(i + 1) % 4], &c = grid.corners[(i + 2) % 4];
    if ((b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]) <= 0)
      corners.fail("must run counter-clockwise round a convex quadrilateral, but at corner " + std::to_string((i + 1) % 4 + 1) +
                   " they do not turn left; reorder or move them");
  }
  const Node cells = node.at("cells");
  const auto two = cells.items(2, "how many cells each way: [nx, ny]");
  const long nx = two[0].count(1), ny = two[1].count(1);
  if (nx > 100'000 || ny > 100'000 || nx * ny > 10'000'000) cells.fail("gives more than ten million cells; use fewer");
  grid.nx = static_cast<int>(nx);
  grid.ny = static_cast<int>(ny);
  return grid;
}

SceneFile read_file(const Node& plate) {
  static const std::vector<std::string> drawings{".geo", ".step", ".stp", ".brep"}, meshes{".msh", ".inp"};
  const Node node = plate.at("file");
  SceneFile file{node.file("the name of a drawing or mesh beside the scene"), 1, false};
  const std::string kind = ending_of(file.path);
  const bool drawing = std::ranges::find(drawings, kind) != drawings.end();
  if (!drawing && std::ranges::find(meshes, kind) == meshes.end())
    node.fail(node.shown() + " must be a drawing (" + listed(drawings) + ") or a mesh (" + listed(meshes) + ")");
  fs::path path;
  try {
    path = contained_file(file.path, fs::path(node.source().file).parent_path());
  } catch (const FileRejected& rejected) {
    node.fail(rejected.what());
  }
  if (!fs::exists(path)) node.fail("there is no file " + path.string() + "; check the path");
  if (!drawing)
    for (const char* key : {"size", "hole size"})
      if (plate.has(key)) plate.at(key).fail("is for drawings, but " + file.path + " is already a mesh; leave it out");
  if (plate.has("unit")) {
    const Node unit = plate.at("unit");
    if (plate.has("scale")) unit.fail("cannot be combined with scale; keep one of them");
    if (kind == ".step" || kind == ".stp") unit.fail("is given in the STEP file itself; leave it out");
    file.scale = find_unit(unit.one_of(choices(plate_keys, "unit")))->factor;
  }
  read_optional(plate, "scale", dimension::number, rule::positive, file.scale);
  file.unit_given = plate.has("unit") || plate.has("scale");
  return file;
}

// Plane strain needs more data of a material than plane stress.
void validate_in_plane(const Node& node, const ScenePlate& plate) {
  try {
    plane_material(plate.material.material, plate.state);
  } catch (const std::invalid_argument& error) {
    const Node at = node.has("material") ? node.at("material") : node.has("orthotropic") ? node.at("orthotropic") : node;
    at.fail(error.what());
  }
}

}  // namespace

ScenePlate read_plate(const Node& node, const std::vector<SceneMaterial>& materials) {
  check_keys(node, plate_keys);
  ScenePlate plate;
  switch (which_kind(node, plate_kinds)) {
    case 0: plate.shape = read_file(node); break;
    case 1: plate.shape = read_link(node.at("link")); break;
    default: plate.shape = read_grid(node.at("grid"));
  }
  plate.thickness = read_size(node.at("thickness"));
  if (node.has("plane"))
    plate.state = node.at("plane").one_of(choices(plate_keys, "plane")) == "strain" ? PlaneState::strain : PlaneState::stress;
  plate.state_given = node.has("plane");
  if (node.has("element")) plate.element = node.at("element").one_of(choices(plate_keys, "element"));
  read_optional(node, "size", dimension::length, rule::positive, plate.size);
  read_optional(node, "hole size", dimension::length, rule::positive, plate.hole_size);
  Made made = read_made(node, plate_keys, materials);
  plate.material = std::move(made.material);
  plate.mass = made.mass;
  validate_in_plane(node, plate);
  return plate;
}

}  // namespace pintle
