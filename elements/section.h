#pragma once

#include <optional>
#include <variant>

namespace pintle {

/// Cross-sections of beams. Height lies in the plane of the mechanism, width across it. All in m.
struct RectangleSection {
  double height, width;
};
struct CircleSection {
  double diameter;
};
struct TubeSection {
  double outer, inner;
};  ///< diameters
/// Flanges are perpendicular to the mechanism's plane: `height` is the overall height, `width` that of the flanges, `web` and `flange` the
/// thicknesses. No fillets.
struct ISection {
  double height, width, web, flange;
};
/// Any other section: A, I and the distances from the axis to the outermost fibres.
struct GivenSection {
  double area;                         ///< A [m²]
  double second_moment;                ///< I about the axis across the plane [m⁴]
  double fibre = 0;                    ///< distance to the outermost fibre; 0: no bending stress is computed [m]
  std::optional<double> shear_factor;  ///< κ, used as given; unset: 5/6
};
using SectionShape = std::variant<RectangleSection, CircleSection, TubeSection, ISection, GivenSection>;

/// The shear factor κ (shear stiffness κGA) of a Timoshenko beam.
/// `cowper`: from section and Poisson's ratio [Cowper1966]: formulas for solid sections for rectangle, circle and tube, the thin-walled one
/// for I; `five_sixths`: 5/6 for all sections.
enum class ShearFactor { cowper, five_sixths };

struct Section {
  double A;      ///< area [m²]
  double I;      ///< second moment about the axis across the plane [m⁴]
  double kappa;  ///< shear factor, in (0, 1] for 0 ≤ ν ≤ ½ –
  double fibre;  ///< axis to outermost fibre: half the height [m]
};
/// `poisson` is used only for `cowper`.
/// @throws std::invalid_argument  a size is not positive, or they contradict each other
Section section(const SectionShape&, ShearFactor, double poisson);

/// Interpolates between two sections of one kind, size by size, with t from 0 to 1: used to divide a tapered beam. An unset shear factor
/// stays unset; combined with a set one it counts as 5/6.
/// @throws std::invalid_argument  the kinds differ
SectionShape between(const SectionShape&, const SectionShape&, double t);

}  // namespace pintle
