#include "framework/analysis/simulate/identity.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include <nlohmann/json.hpp>

#include "framework/common/sha256.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Structures are taken apart by structured bindings, so that a member more does not compile until it is summed too.
class Sum {
 public:
  std::string take() { return sum_.hex(); }

  template <class T>
    requires(std::is_arithmetic_v<T> || std::is_enum_v<T>)
  void add(T x) {
    if constexpr (std::is_floating_point_v<T>)
      if (std::isnan(x)) x = std::numeric_limits<T>::quiet_NaN();
    sum_.add({reinterpret_cast<const char*>(&x), sizeof x});
  }
  template <class... T>
    requires(sizeof...(T) > 1)
  void add(const T&... x) {
    (add(x), ...);
  }
  void add(const std::string& text) {
    add(text.size());
    sum_.add(text);
  }
  template <class Derived>
  void add(const Eigen::MatrixBase<Derived>& m) {
    add(m.rows(), m.cols());
    for (Eigen::Index j = 0; j < m.cols(); ++j)
      for (Eigen::Index i = 0; i < m.rows(); ++i) add(m(i, j));
  }
  template <class T>
  void add(const std::vector<T>& list) {
    add(list.size());
    for (const T& x : list) add(x);
  }
  template <class T, std::size_t n>
  void add(const std::array<T, n>& list) {
    for (const T& x : list) add(x);
  }
  template <class T>
  void add(const std::optional<T>& x) {
    add(x.has_value());
    if (x) add(*x);
  }
  template <class... T>
  void add(const std::variant<T...>& x) {
    add(x.index());
    std::visit([&](const auto& one) { add(one); }, x);
  }

  /// Forty times a decade from a microsecond to ten days.
  void add(const TimeLaw& law) {
    constexpr int decades = 12, each = 40;
    for (int i = -1; i <= decades * each; ++i) try {
        const Jet jet = law(i < 0 ? 0 : 1e-6 * std::pow(10, static_cast<double>(i) / each));
        add(jet.value, jet.rate, jet.accel);
      } catch (const std::exception& outside) {  // of where the law is defined
        add(std::string(outside.what()));
      }
  }

  void add(const Revolute& j) { add(j.a, j.b); }
  void add(const Slot& j) { add(j.a, j.b); }
  void add(const Prismatic& j) { add(j.a, j.b, j.angle); }
  void add(const Weld& j) { add(j.a, j.b, j.angle); }
  void add(const Distance& j) { add(j.a, j.b, j.length); }
  void add(const AngleDriver& j) { add(j.a, j.b, j.law); }
  void add(const DistanceDriver& j) { add(j.a, j.b, j.law); }
  void add(const PointForce& f) {
    const auto& [a, b, x, y, follows] = f;
    add(a, b, x, y, follows);
  }
  void add(const Torque& f) { add(f.a, f.b, f.law); }
  void add(const Spring& f) {
    const auto& [a, b, k, c, free_length] = f;
    add(a, b, k, c, free_length);
  }
  void add(const TorsionSpring& f) {
    const auto& [a, b, k, c, free_angle] = f;
    add(a, b, k, c, free_angle);
  }
  void add(const ContactPair& p) {
    const auto& [journal, bearing, gap, normal, friction, sliding, slowest, link] = p;
    add(journal, bearing, gap.journal, gap.bearing, normal, friction, sliding, slowest, link);
  }
  void add(const ImpactLaw& law) {
    const auto& [k, n, chi, d] = law;
    add(k, n, chi, d);
  }
  void add(const Ambrosio& law) {
    const auto& [mu, v0, v1] = law;
    add(mu, v0, v1);
  }
  void add(const Foreshortening& f) {
    const auto& [S, j, h] = f;
    add(S, j, h);
  }
  void add(const FlexInertia& f) {
    const auto& [S, j, h, G, omega, zeta, second] = f;
    add(S, j, h, G, omega, zeta, second);
  }
  void add(const Body& b) {
    const auto& [name, m, J, x_BO, flex] = b;
    add(name, m, J, x_BO, flex);
  }
  void add(const Marker& m) {
    const auto& [body, x_BP, angle, shape, slope, second] = m;
    add(body, x_BP, angle, shape, slope, second);
  }
  void add(const Integral& z) {
    if (z.account != Account::scheme) add(z.account, z.index);  // which `method: auto` may add as the run becomes longer
  }
  void add(const System& s) {
    const auto& [gravity, bodies, markers, joints, forces, contacts, joint_names, force_names, contact_names, length, eta_begin, scale,
                 row_begin, row_scale, integrals, contact_z, force_z, joint_z] = s;
    add(gravity, bodies, markers, joints, forces, contacts, joint_names, force_names, contact_names, length, eta_begin, scale, row_begin, row_scale);
    for (const Integral& z : integrals) add(z);
    add(contact_z, force_z, joint_z);
  }

 private:
  Sha256 sum_;
};

Json words(const Scene& scene) {
  Json said = Json::parse(scene.filled_in, nullptr, false);
  if (!said.is_object()) return {};  // a scene made in C++
  said.erase("title");
  said.erase("output");
  if (said.contains("run") && said["run"].is_object()) said["run"].erase("until");
  return said;
}

/// Tables, drawings and meshes beside the scene.
void add_files(const Json& said, const fs::path& folder, Sum& sum) {
  if (said.is_string()) {
    const auto& text = said.get_ref<const std::string&>();
    std::error_code error;
    if (text.empty() || text.size() >= 256 || text.find('\n') != std::string::npos || !fs::is_regular_file(folder / text, error)) return;
    std::ifstream in(folder / text, std::ios::binary);
    Sha256 content;
    for (std::string part(1 << 16, '\0'); in.good();) {
      in.read(part.data(), static_cast<std::streamsize>(part.size()));
      content.add(std::string_view(part.data(), static_cast<std::size_t>(in.gcount())));
    }
    sum.add(content.hex());
  } else if (said.is_structured()) {
    for (const Json& item : said) add_files(item, folder, sum);
  }
}

}  // namespace

std::string identity(const Scene& scene, const Model& model, const Assembly& assembly) {
  Sum sum;
  sum.add(model.system);
  const Scheme& s = model.scheme;  // the pair and where it gives way are the saved state's
  sum.add(s.tolerance, s.constraints, s.onset_cut, s.rho, s.max_steps);
  sum.add(assembly.start.t, assembly.start.y.head(2 * model.system.n()));
  const Json said = words(scene);
  sum.add(said.dump(-1, ' ', false, Json::error_handler_t::replace));
  add_files(said, fs::path(scene.file).parent_path(), sum);
  return sum.take();
}

}  // namespace pintle
