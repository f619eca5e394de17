#include "framework/dynamics/equations/islands.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "framework/dynamics/equations/sharing.h"

namespace pintle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

using Contacts = std::vector<UnilateralContact>;

// Visits the indices of a contact's unknowns.
template <class Contact, class Visit>
void visit_unknowns(Contact& k, const Visit& visit) {
  visit(k.normal);
  if (k.tangent >= 0) visit(k.tangent);
  if (k.sliding >= 0) visit(k.sliding);
}

bool move_each_other(const UnilateralContact& a, const UnilateralContact& b, const MatrixXd& W) {
  constexpr double none = 1e-13;
  bool out = false;
  visit_unknowns(a,
                 [&](int i) { visit_unknowns(b, [&](int j) { out = out || std::abs(W(i, j)) > none * std::sqrt(W(i, i) * W(j, j)); }); });
  return out;
}

// The contacts of each independent set, by their indices.
std::vector<std::vector<std::size_t>> sets_apart(std::span<const UnilateralContact> contacts, const MatrixXd& W) {
  std::vector<std::vector<std::size_t>> out;
  std::vector<bool> taken(contacts.size());
  for (std::size_t first = 0; first < contacts.size(); ++first) {
    if (taken[first]) continue;
    std::vector<std::size_t> set{first};
    taken[first] = true;
    for (std::size_t next = 0; next < set.size(); ++next)
      for (std::size_t other = first + 1; other < contacts.size(); ++other)
        if (!taken[other] && move_each_other(contacts[set[next]], contacts[other], W)) taken[other] = true, set.push_back(other);
    std::ranges::sort(set);
    out.push_back(std::move(set));
  }
  return out;
}

// Forces under which all contacts stay closed and stick; nothing if they cannot.
std::optional<VectorXd> holding(const Contacts& contacts, const MatrixXd& W, const VectorXd& c) {
  constexpr double rounding = 1e-11, within = 1e-9;
  if (std::ranges::any_of(contacts, [](const UnilateralContact& k) { return k.sliding >= 0 || k.preload > 0; })) return std::nullopt;
  VectorXd x = share_out(W, -c, VectorXd::Ones(c.size()), one_force, contacts);
  const VectorXd left = W * x + c, terms = W.cwiseAbs() * x.cwiseAbs() + c.cwiseAbs();
  if (!x.allFinite() || (left.array().abs() > rounding * terms.maxCoeff()).any()) return std::nullopt;
  const double most = x.cwiseAbs().maxCoeff();
  for (const UnilateralContact& k : contacts) {
    if (x[k.normal] < -rounding * most) return std::nullopt;
    x[k.normal] = std::max(x[k.normal], 0.0);
    if (k.tangent >= 0 && std::abs(x[k.tangent]) > k.mu * x[k.normal] + within * most) return std::nullopt;
  }
  return x;
}

}  // namespace

std::optional<VectorXd> contact_forces(std::span<const UnilateralContact> contacts, const MatrixXd& W, const VectorXd& c,
                                       std::span<const int> slipping) {
  VectorXd out = VectorXd::Zero(c.size());
  for (const std::vector<std::size_t>& set : sets_apart(contacts, W)) {
    Contacts own;
    std::vector<int> of;
    for (const std::size_t i : set) {
      own.push_back(contacts[i]);
      visit_unknowns(own.back(), [&](int& k) { of.push_back(std::exchange(k, static_cast<int>(of.size()))); });
    }
    const MatrixXd W_own = W(of, of);
    const VectorXd c_own = c(of);
    const bool at_rest = std::ranges::none_of(of, [&](int k) { return std::ranges::find(slipping, k) != slipping.end(); });
    auto x = at_rest ? holding(own, W_own, c_own) : std::nullopt;
    if (!x) x = unilateral_forces(own, W_own, c_own);
    if (!x) return std::nullopt;
    out(of) = *x;
  }
  return out;
}

}  // namespace pintle
