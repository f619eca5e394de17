#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "tests/soak/chance.h"

namespace soak {

struct Point {
  std::string name;
  Eigen::Vector2d at;  ///< body axes
  double angle;
};
struct Link {
  std::string name;
  Eigen::Vector2d r = Eigen::Vector2d::Zero();  ///< origin in the world
  double angle = 0, length = 0;                 ///< length: of a beam
  bool beam = false;
  std::vector<Point> points = {};
  std::string profile = {};  ///< its surface; empty: none
};

/// A mechanism as it has been drawn: bodies in the pose in which they were joined, and the lines that a scene says of the rest.
struct Drawn {
  double size = 1;        ///< of a body, about [m]
  bool aligned = false;   ///< all directions are multiples of a right angle, all lengths of `size` …
  bool flat = false;      ///< … and lie on one line
  bool rigid = false;     ///< surfaces and clearances are of bodies that do not give way …
  bool in_steps = false;  ///< … and the run is by Moreau's steps
  bool wild_masses = false, flexible = false, rough = false, loops = false;
  Eigen::Vector2d gravity = Eigen::Vector2d::Zero();  ///< [m/s²]
  Link ground{.name = "ground"};
  std::vector<Link> links;
  std::vector<std::string> joints, contacts, drivers, forces, starts;
};

/// An angular speed or frequency that suits a size of bodies [rad/s].
double pace(double size, Chance&);
/// The scene file, with random inertia, rough poses and settings.
std::string written(const std::string& title, const Drawn&, Chance&);

}  // namespace soak
