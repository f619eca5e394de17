#pragma once

#include <memory>
#include <vector>

#include "framework/component/fe/touching.h"

/// A disc in the hole of a round eye, meshed and pressed against its wall: what laws of contact are judged by. Plane strain, both of
/// one material. Half of each is meshed, right of the load's line; the mesh grows from the place of contact. Lengths over the hole's
/// radius, forces per length over E* and that radius: E* = E/(2(1 − ν²)) = 1.
namespace pintle_test {

struct DiscInEye {
  double clearance = 1e-3;             ///< ΔR, hole less disc –
  double outer = 2;                    ///< radius of the eye, held all round –
  double core = 0.02;                  ///< radius of a hole in the disc's middle, free –
  double finest = 1e-3, growth = 0.1;  ///< side at the place of contact –, side over the distance from there
  double poisson = 0.3;
  bool load_in_the_middle = false;  ///< the core is rigid and loaded, instead of the whole disc evenly
};

/// One load.
struct Pressed {
  double force = 0;              ///< F/(E*LR_j) –
  double depth = 0;              ///< of the disc's mean displacement (of its core's, where that is loaded) –
  double half_angle = 0;         ///< of the part that touches [rad]
  double greatest_pressure = 0;  ///< over E* –
  double residual = 0;
  std::vector<double> angle, pressure;  ///< [rad], over E* –
};

class PressedDisc {
 public:
  explicit PressedDisc(const DiscInEye&);
  ~PressedDisc();
  Pressed press(double force) const;
  int dofs() const;
  int rows() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pintle_test
