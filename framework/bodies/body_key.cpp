#include "framework/bodies/body_key.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <type_traits>

#include "files/files.h"
#include "framework/bodies/elastic_parts.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;

/// Writes values one after the other so that no two sequences of them look alike. Structures are taken apart by structured
/// bindings: with a member more they no longer compile, and whoever adds one decides here whether it counts.
class Writer {
 public:
  template <class... T>
  void add_all(const T&... values) { (add(values), ...); }

  std::string take() { return std::move(out_); }

 private:
  template <class T>
    requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void add(const T& value) { out_.append(reinterpret_cast<const char*>(&value), sizeof value); }

  void add(const std::string& text) {
    add(text.size());
    out_ += text;
  }

  template <class T>
  void add(const std::vector<T>& values) {
    add(values.size());
    for (const T& value : values) add(value);
  }

  template <class T, std::size_t n>
  void add(const std::array<T, n>& values) {
    for (const T& value : values) add(value);
  }

  template <class T>
  void add(const std::optional<T>& value) {
    add(value.has_value());
    if (value) add(*value);
  }

  template <class... T>
  void add(const std::variant<T...>& value) {
    add(value.index());
    std::visit([&](const auto& one) { add(one); }, value);
  }

  void add(const Eigen::Vector2d& v) { add_all(v.x(), v.y()); }

  void add(const ScenePoint& p) {
    const auto& [name, at, angle, place, hole, coupling] = p;
    add_all(name, at, angle, hole, coupling);
  }

  void add(const SceneLump& l) {
    const auto& [at, mass, inertia, place] = l;
    add_all(at, mass, inertia);
  }

  void add(const Isotropic& m) {
    const auto& [young, poisson] = m;
    add_all(young, poisson);
  }
  void add(const Orthotropic& m) {
    const auto& [young_1, young_2, poisson_12, shear_12, angle, young_3, poisson_13, poisson_23] = m;
    add_all(young_1, young_2, poisson_12, shear_12, angle, young_3, poisson_13, poisson_23);
  }
  void add(const Material& m) {
    const auto& [elastic, density] = m;
    add_all(elastic, density);
  }
  void add(const SceneMaterial& m) {
    const auto& [name, material, place] = m;
    add(material);
  }

  void add(const RectangleSection& s) {
    const auto& [height, width] = s;
    add_all(height, width);
  }
  void add(const CircleSection& s) {
    const auto& [diameter] = s;
    add(diameter);
  }
  void add(const TubeSection& s) {
    const auto& [outer, inner] = s;
    add_all(outer, inner);
  }
  void add(const ISection& s) {
    const auto& [height, width, web, flange] = s;
    add_all(height, width, web, flange);
  }
  void add(const GivenSection& s) {
    const auto& [area, second_moment, fibre, shear_factor] = s;
    add_all(area, second_moment, fibre, shear_factor);
  }
  void add(const SceneBeam& b) {
    const auto& [through, section, taper_to, theory, shear, rotary, bar, material, mass, elements, pieces] = b;
    add_all(through, section, taper_to, theory, shear, rotary, bar, material, mass, elements, pieces);
  }

  void add(const Eye& e) {
    const auto& [bore, outer] = e;
    add_all(bore, outer);
  }
  void add(const StraightBar& l) {
    const auto& [length, width] = l;
    add_all(length, width);
  }
  void add(const EyeBar& l) {
    const auto& [length, width, first, second] = l;
    add_all(length, width, first, second);
  }
  void add(const TaperedBar& l) {
    const auto& [length, width_left, width_right] = l;
    add_all(length, width_left, width_right);
  }
  void add(const Triangle& l) {
    const auto& [center, eye] = l;
    for (const Eigen::Vector2d& c : center) add(c);
    for (const Eye& e : eye) add(e);
  }
  void add(const Disc& l) {
    const auto& [diameter, bore] = l;
    add_all(diameter, bore);
  }
  void add(const SceneFile& f) {
    const auto& [path, scale, unit_given] = f;
    add_all(path, scale, unit_given);
  }
  void add(const SceneGrid& g) {
    const auto& [corners, nx, ny] = g;
    add_all(corners, nx, ny);
  }
  void add(const ScenePlate& p) {
    const auto& [shape, thickness, state, state_given, material, mass, element, size, hole_size] = p;
    add_all(shape, thickness, state, state_given, material, mass, element, size, hole_size);
  }

  void add(const SceneKeep& k) {
    const auto& [automatic, count, below, effective_mass] = k;
    add_all(automatic, count, below, effective_mass);
  }
  void add(const SceneModes& m) {
    const auto& [frame, a, b, method, keep, place] = m;
    add_all(frame, a, b, method, keep);
  }

  std::string out_;
};

/// Words of a Gmsh script that look beyond it, or parts of them: Include, ListFromFile, GetEnv, SystemCall, Rand, OnelabRun, …
constexpr std::string_view outward[]{"Include", "Merge", "Open", "File", "Env", "System", "Rand", "nelab", "ONELAB", "Plugin", "Today",
                                     "Cpu", "Memory", "Exists", "Define", "Get", "SetNumber", "SetString", "Current", "Path", "DirName",
                                     "Executable", "MPI", "General", "Solver", "External"};

/// Whether a drawing may depend on more than its own text. Told generously: if so, it is only made anew.
bool looks_beyond(const std::string& kind, const std::string& text) {
  const auto has = [&](std::string_view word) { return text.find(word) != std::string::npos; };
  if (kind == ".geo") return std::any_of(std::begin(outward), std::end(outward), has);
  if (kind == ".step" || kind == ".stp") return has("DOCUMENT") || has("EXTERNAL");
  if (kind == ".inp") {
    constexpr std::string_view word = "*INCLUDE";  // in letters of any size
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
  } catch (const FileRefused&) {
    return {};  // meshing it says why
  }
  if (text.empty() || looks_beyond(kind_of(file.path), text)) return {};
  return text;
}

}  // namespace

std::optional<std::string> elements_key(const Scene& scene, const SceneBody& body) {
  const auto& [name, mass, inertia, center, points, elastic, at, angle, place] = body;
  const auto& [shape, lumped, lumps, supports, modes, damping, stiffening] = *elastic;
  Writer key;
  key.add_all(points, shape, lumped, lumps);
  if (const auto* plate = std::get_if<ScenePlate>(&shape))
    if (const auto* file = std::get_if<SceneFile>(&plate->shape)) {
      const std::optional<std::string> text = contents(scene, *file);
      if (!text) return {};
      key.add_all(*text);
    }
  return key.take();
}

std::string reduction_key(const SceneElastic& body, const std::vector<int>& ports, const std::optional<int>& chosen) {
  const auto& [shape, lumped, lumps, supports, modes, damping, stiffening] = body;
  Writer key;
  key.add_all(modes, stiffening, ports, chosen);
  return key.take();
}

}  // namespace pintle
