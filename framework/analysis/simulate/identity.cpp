#include "framework/analysis/simulate/identity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <new>

#include <nlohmann/json.hpp>

#include "framework/common/fingerprint.h"
#include "framework/common/some_of.h"
#include "framework/common/library_threads.h"
#include "framework/common/value_writer.h"
#include "framework/dynamics/solvers/sparse_ldl.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class Sum : public ValueWriter<Sum> {
 public:
  using ValueWriter::add;
  void bytes(std::string_view some) { sum_ = fingerprint(some, sum_); }
  std::string text() const { return fingerprint_text(sum_); }

  void add(const TimeLaw& law) {
    if (!law) return add(false);
    for (int i = -1; i <= samples; ++i)
      sample([&] {
        const Jet jet = law(i < 0 ? 0 : sampled(i));
        add(jet.value, jet.rate, jet.accel);
      });
  }

  template <class Kind>
  requires requires(const Kind& kind) { kind.members(); }
  void add(const Kind& joint_or_force) {
    std::apply([this](const auto&... member) { this->add(member...); }, joint_or_force.members());
  }
  void add(const Relation& relation) {
    const auto& [ends, coordinates, curve, properties, constant] = relation;
    for (const int marker : ends) add(marker);
    add(coordinates, curve, rows(Joint{relation}), constant);
  }
  void add(const Coordinate& c) {
    const auto& [kind, a, b, ratio] = c;
    add(kind, a, b, ratio);
  }
  void add(const ContactPair& p) {
    const auto& [a, b, gap, normal, friction, sliding, slowest, follows, link, pair, pairs, profiles, deepest, extent, beyond, rigid, slack,
                 pressure, journal, flank, written_on_a, massless] = p;
    add(a, b, gap.a, gap.b, normal, friction, sliding, slowest, follows, link, pair, pairs, profiles, deepest, extent, beyond, rigid, slack,
        written_on_a);
    if (flank) add(*flank);
    if (massless) add(Eigen::MatrixXd(massless->a), Eigen::MatrixXd(massless->b));
  }
  void add(const Flank& flank) {
    const auto& [teeth, side, half, angle] = flank;
    add(teeth, side, half, angle);
  }
  void add(const Piece& piece) {
    const auto& [radius, centre, normal, half, straight, curve] = piece;
    add(radius, centre, normal, half, straight);
    if (curve) add(curve->numbers());
  }
  void add(const RigidImpact& impact) {
    const auto& [restitution, tangential, poisson] = impact;
    add(restitution, tangential, poisson);
  }
  void add(const NormalLaw& law) {
    if (const auto* impact = std::get_if<ImpactLaw>(&law)) return add(*impact);
    const auto& [elastic, chi, deepest, name, limit] = *std::get_if<DampedLaw>(&law);
    add(elastic, chi);
  }
  void add(const PowerForce& law) {
    const auto& [k, n] = law;
    add(k, n);
  }
  void add(const LogarithmicForce& law) {
    const auto& [S, G] = law;
    add(S, G);
  }
  void add(const WideningForce& law) {
    const auto& [k, clearance] = law;
    add(k, clearance);
  }
  void add(const FoundationForce& law) {
    const auto& [k, clearance] = law;
    add(k, clearance);
  }
  void add(const ForceTable& law) {
    for (const auto& [depth, force, slope, stored] : law.knots) add(depth, force);
  }
  void add(const ImpactLaw& law) {
    const auto& [k, n, chi, d] = law;
    add(k, n, chi, d);
  }
  void add(const Ambrosio& law) {
    const auto& [mu, v0, v1] = law;
    add(mu, v0, v1);
  }
  void add(const Threlfall& law) {
    const auto& [mu, v1] = law;
    add(mu, v1);
  }
  void add(const HyperbolicTangent& law) {
    const auto& [mu, v1] = law;
    add(mu, v1);
  }
  void add(const BengisuAkay& law) {
    const auto& [mu, mu_static, v0, v1] = law;
    add(mu, mu_static, v0, v1);
  }
  void add(const Coulomb& law) {
    const auto& [mu, mu_static, stribeck] = law;
    add(mu, mu_static, stribeck);
  }
  void add(const LuGre& law) {
    const auto& [mu, mu_static, stribeck, stiffness, damping, viscous, damping_speed] = law;
    add(mu, mu_static, stribeck, stiffness, damping, viscous, damping_speed);
  }
  void add(const Gonthier& law) {
    const auto& [mu, mu_static, stribeck, stiffness, damping, viscous, dwell] = law;
    add(mu, mu_static, stribeck, stiffness, damping, viscous, dwell);
  }
  void add(const JointFriction& f) {
    const auto& [joint, law, radius, length, preload] = f;
    add(joint, law, radius, length, preload);
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
  void add(const Switch& one) {
    const auto& [of, index, released] = one;
    add(of, index, released);
  }
  void add(const MotionSignal& signal) {
    const auto& [kind, a, b, offset] = signal;
    add(kind, a, b, offset);
  }
  /// Samples it at the times of a law of time, with signals of both signs over the same decades; signal k (from 0) is 1 + 0.1 k times the first.
  void add(const SignalLaw& law) {
    const auto& [of, in, sided, first_side] = law;  // the sides belong to the same function
    add(in);
    std::array<double, most_law_inputs> at;
    for (int i = -1; i <= samples; ++i)
      sample([&, &value = of] {
        const double size = i < 0 ? 0 : (i % 2 == 0 ? 1 : -1) * sampled(7 * i % samples);
        for (std::size_t k = 0; k < at.size(); ++k) at[k] = size * (1 + 0.1 * static_cast<double>(k));
        add(value(i < 0 ? 0 : sampled(i), at.data(), nullptr));
      });
  }
  void add(const OwnState& state) {
    const auto& [name, unit, scale, start, rate] = state;
    add(name, unit, scale, start, rate);
  }
  void add(const Integral& z) {
    if (z.account != Account::scheme) add(z.account, z.index);  // `method: auto` may add it for a longer run
  }
  void add(const System& s) {
    const auto& [gravity, bodies, markers, joints, frictions, forces, contacts, signals, laws, states, joint_names, force_names,
                 contact_names, loose, loose_names, length, eta_begin, scale, row_begin, end_begin, end_marker, row_scale, integrals,
                 contact_z, force_z, joint_z, internal, force_x, x_scale, contact_x, friction_x, own_x, switches, joint_switch,
                 force_switch, contact_switch] = s;
    add(gravity, bodies, markers, joints, frictions, forces, contacts, joint_names, force_names, contact_names, loose, loose_names, length,
        eta_begin, scale, row_begin, end_begin, end_marker, row_scale);
    for (const Integral& z : integrals) add(z);
    add(contact_z, force_z, joint_z, force_x, x_scale, signals, laws, states, switches);
  }

 private:
  static constexpr int decades = 12, each = 40, samples = decades * each;
  /// From 1e-6 s to 1e6 s (eleven days), or signals of this size in SI units.
  static double sampled(int i) { return 1e-6 * std::pow(10, static_cast<double>(i) / each); }
  /// The message of a law outside its range is added too.
  void sample(const std::function<void()>& add_value) {
    try {
      add_value();
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& outside) {
      add(std::string(outside.what()));
    }
  }

  std::uint64_t sum_ = fingerprint("");
};

Json words(const Scene& scene) {
  Json said = Json::parse(scene.filled_in, nullptr, false);
  if (!said.is_object()) return {};  // a scene made in C++
  said.erase("title");
  said.erase("output");
  if (said.contains("bodies") && said["bodies"].is_object())
    for (Json& body : said["bodies"])
      if (body.is_object()) body.erase("colour");
  if (said.contains("run") && said["run"].is_object()) said["run"].erase("until");
  return said;
}

std::string sum_of(const Json& said) { return fingerprint_text(fingerprint(said.dump(-1, ' ', false, Json::error_handler_t::replace))); }

/// Checksums of each section, and of each of its entries: "bodies.crank".
Json sums_of_words(const Json& said) {
  Json out = Json::object();
  for (const auto& [section, inside] : said.items()) {
    if (!inside.is_object())
      out[section] = sum_of(inside);
    else
      for (const auto& [key, item] : inside.items()) out[section + "." + key] = sum_of(item);
  }
  return out;
}

/// Adds tables, drawings and meshes next to the scene, by their names in it.
void add_files(const Json& said, const fs::path& folder, Json& out) {
  if (said.is_string()) {
    const auto& text = said.get_ref<const std::string&>();
    std::error_code error;
    if (text.empty() || text.size() >= 256 || text.find('\n') != std::string::npos || !fs::is_regular_file(folder / text, error)) return;
    std::ifstream in(folder / text, std::ios::binary);
    Sum content;
    for (std::string part(1 << 16, '\0'); in.good();) {
      in.read(part.data(), static_cast<std::streamsize>(part.size()));
      content.bytes(std::string_view(part.data(), static_cast<std::size_t>(in.gcount())));
    }
    out[text] = content.text();
  } else if (said.is_structured()) {
    for (const Json& item : said) add_files(item, folder, out);
  }
}

std::string sum_of(const Model& model, const Assembly& assembly) {
  Sum sum;
  sum.add(model.system);
  const Scheme& s = model.scheme;  // the pair and its fallback are those of the saved state
  sum.add(s.tolerance, s.constraints, s.onset_cut, s.rho, s.max_steps);
  sum.add(assembly.start.t, assembly.start.y.head(2 * model.system.n()));
  return sum.text();
}

/// The names for which two such lists differ, including those missing in one of them.
std::vector<std::string> differing(const Json& one, const Json& other) {
  std::vector<std::string> out;
  if (!one.is_object() || !other.is_object()) return out;
  for (const auto& [name, sum] : one.items())
    if (!other.contains(name) || other[name] != sum) out.push_back(name);
  for (const auto& [name, sum] : other.items())
    if (!one.contains(name)) out.push_back(name);
  return out;
}

bool uses_blas(const System& system) {
  const auto flexible = [](const Body& body) { return body.modes() > 0; };
  return std::max(system.n(), system.n_rows()) > SparseLdl::few || std::ranges::any_of(system.bodies, flexible);
}

}  // namespace

std::string identity(const Scene& scene, const Model& model, const Assembly& assembly) {
  const Json said = words(scene);
  Json files = Json::object();
  add_files(said, fs::path(scene.file).parent_path(), files);
  const Json all{{"scene", sums_of_words(said)},
                 {"files", files},
                 {"mechanism", sum_of(model, assembly)},
                 {"program", PINTLE_VERSION ", compiled by " __VERSION__},
                 {"blas", uses_blas(model.system) ? library_text() : "not used"}};
  return all.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string difference(const std::string& saved, const std::string& now) {
  const Json was = Json::parse(saved, nullptr, false), is = Json::parse(now);
  const auto part = [&](const char* name) { return was.is_object() && was.contains(name) ? was[name] : Json(); };
  const std::vector<std::string> words = differing(part("scene"), is["scene"]), files = differing(part("files"), is["files"]);
  const std::string remedy = "; restore them and the --set values, or run the scene from its start";
  std::string out;
  if (!words.empty())
    out = "belongs to another scene, or to this one before it was changed (only title, run.until and output may change): " +
          some_of(words, false) + (words.size() > 1 ? " differ" : " differs");
  if (!files.empty())
    out += (out.empty() ? "" : ", and ") + std::string("a file that the scene names has changed since: ") + some_of(files, false);
  if (!out.empty()) return out + remedy;
  if (part("mechanism") == is["mechanism"]) return "";
  const auto other = [&](const char* name, const char* what) {
    if (part(name) == is[name]) return;
    out += (out.empty() ? "" : ", and ") + std::string(what) + " is " + is[name].get<std::string>() + ", but it was saved with " +
           (part(name).is_string() ? part(name).get<std::string>() : "another");
  };
  other("program", "the program");
  other("blas", "BLAS");
  if (!out.empty())
    return "holds a mechanism whose numbers differ from this one's in their last digits: " + out +
           "; continue with the program and BLAS that saved it (for OpenBLAS: OPENBLAS_CORETYPE, OPENBLAS_NUM_THREADS), or run the scene "
           "from its start";
  return "belongs to another scene: the numbers of its mechanism differ, although its text and files do not; restore the parts made in "
         "C++, or run the scene from its start";
}

}  // namespace pintle
