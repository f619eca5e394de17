#pragma once

#include "contact/gap.h"

namespace pintle {

/// `evaluate` and `places` for pairs with a curve. docs/theory/contact.md, Curves
Gap evaluate_curves(const PiecePair&, const MovingPoint& a, const MovingPoint& b);
std::array<PlaceOn, 2> places_on_curves(const PiecePair&, const Gap&, const MovingPoint& a, const MovingPoint& b);

PlaceOn place_on_arc(const Piece&, const Gap&, const Eigen::Vector2d& normal, const MovingPoint& by);

}  // namespace pintle
