#include "framework/analysis/natural_modes/natural_modes.h"

#include <chrono>
#include <numbers>

#include <nlohmann/json.hpp>

#include "framework/bodies/in_body.h"
#include "framework/build/preliminary_run.h"
#include "framework/common/text.h"
#include "framework/component/eigen/eigen_lowest.h"
#include "framework/component/fe/assembly.h"
#include "framework/scene/yaml/json_text.h"

namespace pintle {

namespace {

/// The lowest modes of the body with the `held` degrees of freedom fixed, as shapes of all degrees of freedom.
ModalModel held_modes(const ElasticBody& e, const Component& c, const Supports& held, int count, int& rigid) {
  const std::vector<int> free = free_dofs(e.model, held);
  const Sparse K = restricted(c.K, free), M = restricted(c.M, free);
  EigenOptions options;
  options.count = count;
  EigenPairs pairs = eigen_lowest(K, M, options);
  if (pairs.zero > 0) {  // the supports leave rigid motions: keep the requested number of elastic modes
    rigid = pairs.zero;
    options.count = count + rigid;
    pairs = eigen_lowest(K, M, options);
  }
  if (!pairs.converged || pairs.missed > 0)
    throw std::runtime_error("its modes were not found: " +
                             (pairs.reason.empty() ? std::to_string(pairs.missed) + " missed by the Sturm check" : pairs.reason));
  bool sound = pairs.zero <= rigid_motions_left(e.model, held);
  for (Eigen::Index i = pairs.zero; i < pairs.lambda.size(); ++i) sound = sound && pairs.lambda[i] > 0 && pairs.residual[i] <= 1e-2;
  if (!sound)
    throw std::runtime_error(
        "it has motions without stiffness other than rigid-body motions (bars hinged in a line, or a part more than ten thousand times as "
        "long as thick?); support them, or use a beam theory with bending and a thicker section");
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(e.model.n(), count);
  for (std::size_t i = 0; i < free.size(); ++i) all.row(free[i]) = pairs.shapes.row(static_cast<Eigen::Index>(i)).tail(count);
  ModalModel out;
  out.shapes = nodal(e.model, all);
  out.omega = pairs.lambda.tail(count).cwiseSqrt();
  out.residual = pairs.residual.tail(count);
  out.sturm = static_cast<int>(pairs.lambda.size()) + pairs.missed;
  return out;
}

nlohmann::ordered_json table_json(const ModeTable& t, const ModesReport& r) {
  auto rows = nlohmann::ordered_json::array();
  for (Eigen::Index i = 0; i < t.modes.omega.size(); ++i)
    rows.push_back({{"mode", i + 1},
                    {"frequency [Hz]", t.modes.omega[i] / (2 * std::numbers::pi)},
                    {"omega [rad/s]", t.modes.omega[i]},
                    {"effective mass x [kg]", t.mass(0, i)},
                    {"effective mass y [kg]", t.mass(1, i)},
                    {"effective inertia [kg m^2]", t.mass(2, i)},
                    {"share x", t.mass(0, i) / r.inertia.m},
                    {"share y", t.mass(1, i) / r.inertia.m},
                    {"share rotation", r.centre_inertia > 0 ? t.mass(2, i) / r.centre_inertia : 0},
                    {"damping ratio", t.zeta[i]},
                    {"residual", t.modes.residual[i]}});
  return {{"basis", t.title}, {"modes", rows}};
}

}  // namespace

ModesReport modes_of(const Scene& scene, const ElasticBody& e, int count) {
  ModesReport r;
  r.inertia = rigid_inertia(e.model, e.M);
  r.centre_inertia = r.inertia.J - r.inertia.c.squaredNorm() / r.inertia.m;
  const std::vector<NamedSupport> supports = supports_of(scene, e);
  const auto start = std::chrono::steady_clock::now();
  in_body(scene, *e.scene, [&] {
    const Component c = component_of(e);
    r.natural.title = "free";
    for (const NamedSupport& s : supports) r.natural.title = (&s == &supports.front() ? "held at " : r.natural.title + ", ") + s.at;
    if (supports.empty()) {
      r.natural.modes = normal_modes(c, {ReferenceConditions::mean_axes}, {count, {}, {}, false});
      r.rigid = 3;
    } else {
      r.natural.modes = held_modes(e, c, together(supports), count, r.rigid);
    }
  });
  r.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (e.scene->elastic->modes) {
    r.reduced.emplace();
    r.reduced->title = title_of(*e.scene->elastic->modes);
    std::optional<int> chosen;
    if (e.scene->elastic->modes->keep.automatic) chosen = choose_modes(scene, e).count;
    r.reduced->modes = reduce(scene, e, chosen);
  }
  for (ModeTable* t : {&r.natural, r.reduced ? &*r.reduced : nullptr}) {
    if (!t) continue;
    t->mass = effective_mass(e.model, e.M, t->modes);
    t->zeta = damping_of(scene, *e.scene, t->modes.omega, (r.reduced ? *r.reduced : r.natural).modes.omega);
  }
  return r;
}

std::string modes_csv(const ModeTable& t, const ModesReport& r) {
  std::string out =
      "mode,frequency [Hz],effective mass x [kg],effective mass y [kg],effective inertia [kg m^2],share x,share y,share rotation,damping "
      "ratio,residual\n";
  for (Eigen::Index i = 0; i < t.modes.omega.size(); ++i) {
    out += std::to_string(i + 1);
    for (const double v :
         {t.modes.omega[i] / (2 * std::numbers::pi), t.mass(0, i), t.mass(1, i), t.mass(2, i), t.mass(0, i) / r.inertia.m,
          t.mass(1, i) / r.inertia.m, r.centre_inertia > 0 ? t.mass(2, i) / r.centre_inertia : 0, t.zeta[i], t.modes.residual[i]}) {
      out += ',';
      append_number(out, v);
    }
    out += '\n';
  }
  return out;
}

std::string modes_json(const Scene& scene, const ElasticBody& e, const ModesReport& r) {
  nlohmann::ordered_json out = {{"program", "pintle"},
                                {"version", PINTLE_VERSION},
                                {"command", "modes"},
                                {"title", scene.title},
                                {"file", scene.file},
                                {"body", e.scene->name},
                                {"nodes", e.mesh.x.cols()},
                                {"cells", e.mesh.cell_count()},
                                {"freedoms", e.model.n()},
                                {"mass [kg]", r.inertia.m},
                                {"centre [m]", {r.inertia.c.x() / r.inertia.m, r.inertia.c.y() / r.inertia.m}},
                                {"inertia about the centre [kg m^2]", r.centre_inertia},
                                {"warnings", e.warnings},
                                {"rigid motions", r.rigid},
                                {"natural", table_json(r.natural, r)}};
  if (r.natural.modes.sturm) out["natural"]["Sturm count"] = *r.natural.modes.sturm;
  if (r.reduced) out["reduced"] = table_json(*r.reduced, r);
  out["timings [s]"] = {{"mesh", e.mesh_seconds}, {"assembly", e.assembly_seconds}, {"modes", r.seconds}};
  return text_with_scene(out, scene);
}

}  // namespace pintle
