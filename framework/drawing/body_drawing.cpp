#include "framework/drawing/body_drawing.h"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "framework/drawing/vtk.h"

namespace pintle {

namespace {

constexpr int pieces_per_beam = 8;

/// Rotation of the section; for a bar that of its chord.
Eigen::Matrix<double, 1, 4> rotation(const Bar&, const Coords<Bar>& x, double) {
  const Eigen::Vector2d d = x.col(1) - x.col(0);
  const Eigen::RowVector2d across = Eigen::RowVector2d(-d.y(), d.x()) / d.squaredNorm();
  Eigen::Matrix<double, 1, 4> row;
  row << -across, across;
  return row;
}

// Half height drawn for a section; a fiftieth of the body's size if the section has no height.
double half_height(const Fibre& fibre, double length) { return fibre.distance > 0 ? fibre.distance : 0.02 * length; }

constexpr int stations = pieces_per_beam + 1;
constexpr int across = 3;  // right side, axis, left side

/// Position of a point of the ribbon: points are ordered by element, by station along it, from right to left.
struct BeamStation {
  int element;
  double t;     ///< along it, 0 to 1
  double side;  ///< −1 at the right edge, 0 on the axis, 1 at the left edge
};
BeamStation beam_station(int point) {
  return {point / (across * stations), static_cast<double>(point / across % stations) / pieces_per_beam, point % across - 1.0};
}

}  // namespace

BodyDrawing::BodyDrawing(const ElasticBody& body) : body_(body) {
  size = (body.mesh.x.rowwise().maxCoeff() - body.mesh.x.rowwise().minCoeff()).norm();
  if (body.plate()) {
    points = body.mesh.x;
    cells = body.mesh.cells;
    return;
  }
  const FeModel& model = body.model;
  std::vector<Eigen::Triplet<double>> entries;
  Cells quads{CellShape::quadrilateral4, {}, {}};
  std::visit(
      [&](const auto& block) {
        using E = std::decay_t<decltype(block.properties.front())>;
        if constexpr (E::stress_rows == 3) {
          points.resize(2, block.size() * stations * across);
          for (int i = 0; i < block.size(); ++i) {
            const Coords<E> x = block.coords(i, model.x);
            const Eigen::Vector2d d = x.col(1) - x.col(0), n = Eigen::Vector2d(-d.y(), d.x()).normalized();
            const double y = half_height(body.fibres[static_cast<std::size_t>(i)], size);
            for (int s = 0; s < stations; ++s) {
              const double xi = static_cast<double>(s) / pieces_per_beam;
              const auto N = shape(block.element(i), x, {xi, 0});
              const auto turn = rotation(block.element(i), x, xi);
              for (int side = 0; side < across; ++side) {
                const Eigen::Vector2d offset = (side - 1) * y * n;
                const int p = (i * stations + s) * across + side;
                points.col(p) = x.col(0) + xi * d + offset;
                for (int k = 0; k < E::dofs; ++k) {
                  const int dof = model.begin[static_cast<std::size_t>(block.nodes_of(i)[k / E::dofs_per_node])] + k % E::dofs_per_node;
                  entries.emplace_back(2 * p, dof, N(0, k) - offset.y() * turn(0, k));
                  entries.emplace_back(2 * p + 1, dof, N(1, k) + offset.x() * turn(0, k));
                }
              }
              if (s == 0) continue;
              for (int side = 0; side + 1 < across; ++side) {
                const int p = (i * stations + s - 1) * across + side;
                quads.nodes.insert(quads.nodes.end(), {p, p + across, p + across + 1, p + 1});
                quads.numbers.push_back(static_cast<long>(quads.numbers.size()) + 1);
              }
            }
          }
        }
      },
      model.blocks.front());
  D_.resize(points.size(), model.N());
  D_.setFromTriplets(entries.begin(), entries.end());
  cells.push_back(std::move(quads));
}

Eigen::Matrix2Xd BodyDrawing::displacement(const Eigen::VectorXd& u) const {
  const Eigen::VectorXd all = body_.plate() ? u : Eigen::VectorXd(D_ * u);
  return Eigen::Map<const Eigen::Matrix2Xd>(all.data(), 2, all.size() / 2);
}

Eigen::Matrix4Xd BodyDrawing::stress(const Eigen::VectorXd& u) const { return stress(stress_field(body_.model, u, body_.fibres)); }

Eigen::Matrix3Xd BodyDrawing::section_forces(const StressField& field) const {
  if (body_.plate()) return Eigen::Matrix3Xd(3, 0);
  Eigen::Matrix3Xd out(3, points.cols());
  for (int p = 0; p < points.cols(); ++p) {
    const BeamStation at = beam_station(p);
    out.col(p) = (1 - at.t) * field.section_forces.col(2 * at.element) + at.t * field.section_forces.col(2 * at.element + 1);
  }
  return out;
}

Eigen::Matrix4Xd BodyDrawing::stress(const StressField& field) const {
  if (body_.plate()) return field.nodal;
  const Eigen::Matrix3Xd forces = section_forces(field);
  Eigen::Matrix4Xd out = Eigen::Matrix4Xd::Zero(4, points.cols());
  for (int p = 0; p < points.cols(); ++p) {
    const BeamStation at = beam_station(p);
    const Fibre& fibre = body_.fibres[static_cast<std::size_t>(at.element)];
    const double bending = fibre.I > 0 ? forces(2, p) * fibre.distance / fibre.I : 0;
    out(0, p) = forces(0, p) / fibre.A - at.side * bending;  // M > 0 stretches the right side
  }
  return out;
}

namespace {

/// A shape scaled to a largest displacement of 1 mm: displacements [mm] and the stress per mm [Pa].
struct Scaled {
  Eigen::Matrix2Xd u;
  Eigen::RowVectorXd mises;
};
Scaled scaled(const BodyDrawing& drawing, const Eigen::VectorXd& shape) {
  Scaled out{drawing.displacement(shape), {}};
  const double greatest = out.u.colwise().norm().maxCoeff();
  const double factor = greatest > 0 ? 1 / greatest : 0;
  out.u *= factor;
  const Eigen::Matrix4Xd sigma = drawing.stress(shape) * (factor * 1e-3);
  out.mises.resize(sigma.cols());
  for (Eigen::Index i = 0; i < sigma.cols(); ++i) out.mises[i] = von_mises(sigma.col(i));
  return out;
}

}  // namespace

void write_shapes(const std::filesystem::path& file, const BodyDrawing& drawing, const Eigen::MatrixXd& shapes) {
  std::vector<Field> fields;
  for (Eigen::Index i = 0; i < shapes.cols(); ++i) {
    char number[16];
    std::snprintf(number, sizeof number, "%02d", static_cast<int>(i + 1));
    const Scaled s = scaled(drawing, shapes.col(i));
    fields.push_back({std::string("mode ") + number + " [mm]", s.u});
    fields.push_back({std::string("von Mises ") + number + " [Pa/mm]", s.mises});
  }
  write_grid(file, drawing.points, drawing.cells, fields);
}

void write_shape_animation(const std::filesystem::path& directory, const std::string& name, const BodyDrawing& drawing,
                           const Eigen::VectorXd& shape, int frames) {
  const Scaled s = scaled(drawing, shape);
  const double drawn = 0.1 * drawing.size;  // largest displacement in the picture [m]
  std::vector<CollectedFile> files;
  for (int f = 0; f < frames; ++f) {
    const double phase = static_cast<double>(f) / frames, a = std::sin(2 * std::numbers::pi * phase);
    char file[96];
    std::snprintf(file, sizeof file, "frames/%s_%02d.vtu", name.c_str(), f);
    write_grid(directory / file, drawing.points + a * drawn * s.u, drawing.cells,
               {{"displacement [mm]", a * s.u},
                {"von Mises [Pa/mm]", std::abs(a) * s.mises},
                {"scale", Eigen::RowVectorXd::Constant(s.u.cols(), drawn / 1e-3)}},
               {}, phase);
    files.push_back({phase, file});
  }
  write_collection(directory / (name + ".pvd"), files);
}

}  // namespace pintle
