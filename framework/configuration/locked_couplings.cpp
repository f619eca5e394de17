#include "framework/configuration/locked_couplings.h"

#include <algorithm>
#include <map>
#include <set>
#include <variant>

#include <Eigen/QR>

#include "framework/common/index.h"
#include "framework/common/some_of.h"
#include "framework/common/text.h"
#include "framework/dynamics/equations/equations.h"

namespace pintle {

namespace {

using Eigen::MatrixXd;
using Index = Eigen::Index;

bool couples(const Joint& joint) {
  return std::holds_alternative<Gear>(joint) || std::holds_alternative<Rack>(joint) || std::holds_alternative<RollsOnDisc>(joint) ||
         std::holds_alternative<RollsOnLine>(joint) || std::holds_alternative<Relation>(joint);
}

/// Finds which bodies can move at a pose, with drivers released and a joint removed.
class FreeBodies {
 public:
  FreeBodies(const System& system, double t, const Eigen::VectorXd& y) : system_(system), J_(MatrixXd::Zero(system.n_rows(), system.n())) {
    Equations eq(system);
    pose(system, t, y, eq);
    visit_jacobian(eq, [&](int row, int column, double value) { J_(row, column) += system.row_scale[row] * system.scale[column] * value; });
    for (std::size_t k = 0; k < system.joints.size(); ++k)
      if (is_driver(system.joints[k])) rows_of(static_cast<int>(k)).setZero();
  }

  /// Bodies that the rows of a joint act on.
  std::set<Index> bodies_of(int joint) {
    std::set<Index> out;
    const Index bodies = std::ssize(system_.bodies);
    for (Index column = 0; column < 3 * bodies; ++column)
      if (!rows_of(joint).col(column).isZero(0)) out.insert(column / 3);
    return out;
  }

  /// Bodies that can move without this joint; -1: with all joints.
  std::set<Index> moving(int without) {
    constexpr double rounding = 1e-9;
    MatrixXd J = J_;
    if (without >= 0) J.middleRows(first(without), count(without)).setZero();
    Eigen::ColPivHouseholderQR<MatrixXd> qr(J.transpose());
    qr.setThreshold(rounding);
    const MatrixXd Q = qr.householderQ();
    const MatrixXd free = Q.rightCols(J.cols() - qr.rank());
    std::set<Index> out;
    for (Index b = 0; b < std::ssize(system_.bodies); ++b)
      if (free.cols() > 0 && free.middleRows(3 * b, 3).lpNorm<Eigen::Infinity>() > rounding) out.insert(b);
    return out;
  }

 private:
  Index first(int joint) const { return system_.row_begin[at(joint)]; }
  Index count(int joint) const { return system_.row_begin[at(joint) + 1] - first(joint); }
  Eigen::Block<MatrixXd> rows_of(int joint) { return J_.block(first(joint), 0, count(joint), J_.cols()); }

  const System& system_;
  MatrixXd J_;
};

Index shared_bodies(const std::set<Index>& some, const std::set<Index>& all) {
  return std::ranges::count_if(some, [&](Index b) { return all.contains(b); });
}

std::string train_text(const System& system, const std::vector<int>& train) {
  std::vector<std::string> names;
  for (const int k : train) names.push_back(system.joint_names[at(k)]);
  return "the couplings " + some_of(names) +
         " hold each other still: their ratios contradict each other, so that nothing turns between them; correct one, or leave it out";
}

}  // namespace

std::vector<std::string> locked_couplings(const System& system, double t, const Eigen::VectorXd& y) {
  constexpr Index most = 300;
  std::vector<int> all;
  for (std::size_t k = 0; k < system.joints.size(); ++k)
    if (couples(system.joints[k])) all.push_back(static_cast<int>(k));
  if (all.size() < 2 || system.n() > most) return {};

  FreeBodies free_bodies(system, t, y);
  const std::set<Index> moving = free_bodies.moving(-1);
  std::map<int, std::set<Index>> bodies, freed;  // bodies of each locked coupling; bodies that can move without it
  for (const int k : all)
    if (const std::set<Index> of = free_bodies.bodies_of(k); !of.empty() && shared_bodies(of, moving) == 0) bodies[k] = of;
  for (const auto& [k, of] : bodies) freed[k] = free_bodies.moving(k);
  const auto frees = [&](int gone, int other) {
    const std::set<Index>& of = bodies.at(other);
    return shared_bodies(of, freed.at(gone)) >= std::min<Index>(2, std::ssize(of));
  };

  std::vector<std::string> out;
  std::set<int> reported;
  for (const auto& [k, of] : bodies) {
    if (reported.contains(k) || !frees(k, k)) continue;
    std::vector<int> train;
    for (const auto& [other, ends] : bodies)
      if (frees(k, other) && frees(other, k)) train.push_back(other);
    if (train.size() < 2) continue;
    reported.insert(train.begin(), train.end());
    out.push_back(train_text(system, train));
  }
  return out;
}

}  // namespace pintle
