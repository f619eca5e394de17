#include "framework/bodies/body_store.h"

#include <string>

#include "framework/bodies/body_key.h"
#include "framework/bodies/modal_basis.h"

namespace pintle {

namespace {

template <class M>
std::size_t dense(const M& m) {
  return static_cast<std::size_t>(m.size()) * sizeof(typename M::Scalar);
}

std::size_t sparse(const Sparse& m) {
  return static_cast<std::size_t>(m.nonZeros()) * (sizeof(double) + sizeof(int)) + static_cast<std::size_t>(m.cols()) * sizeof(int);
}

template <class T>
std::size_t list(const std::vector<T>& v) {
  return v.size() * sizeof(T);
}

std::size_t cells(const std::vector<Cells>& all) {
  std::size_t bytes = 0;
  for (const Cells& c : all) bytes += list(c.nodes) + list(c.numbers);
  return bytes;
}

/// Memory of the parts that grow with the mesh.
std::size_t bytes_of(const ElasticBody& e) {
  std::size_t bytes = sizeof e + dense(e.mesh.x) + list(e.mesh.node_numbers) + cells(e.mesh.cells) + list(e.quality.cells) +
                      dense(e.model.x) + list(e.model.begin) + list(e.model.independent) + sparse(e.model.L) + sparse(e.K) + sparse(e.M) +
                      list(e.fibres);
  for (const Group& g : e.mesh.groups) bytes += list(g.nodes) + cells(g.sides);
  for (const AnyBlock& any : e.model.blocks)
    bytes += std::visit([](const auto& block) { return list(block.properties) + list(block.nodes) + list(block.cells); }, any);
  return bytes;
}

std::size_t bytes_of(const Reduction& r) {
  std::size_t bytes = sizeof r + dense(r.modes.shapes) + dense(r.modes.ports) + dense(r.inertia.G);
  for (const auto& port : r.second) bytes += dense(port[0]) + dense(port[1]);
  if (r.inertia.second) bytes += 4 * dense(r.inertia.second->j);
  return bytes;
}

}  // namespace

BodyStore::BodyStore(std::size_t most_bytes) : bodies_(most_bytes / 4 * 3, bytes_of), reductions_(most_bytes / 4, bytes_of) {}

ElasticBody BodyStore::elastic(const Scene& scene, const SceneBody& body) {
  const std::optional<std::string> key = elements_key(scene, body);
  const auto make = [&] {
    ElasticBody made = elastic_body(scene, body);
    const long number = ++bodies_made_;
    if (key) made.number = number;
    return made;
  };
  if (!key) return make();
  ElasticBody out = *bodies_.get(*key, make);
  out.scene = &body;
  return out;
}

Reduction BodyStore::reduction(const Scene& scene, const ElasticBody& e, std::optional<int> chosen) {
  const auto make = [&] {
    ++reductions_made_;
    return reduction_of(scene, e, chosen);
  };
  if (e.number == 0 || !e.scene->elastic->modes) return make();
  const std::string key = reduction_key(*e.scene->elastic, interface_of(scene, e), massless_ports(scene, e), chosen);
  return *reductions_.get(std::to_string(e.number) + ":" + key, make);
}

}  // namespace pintle
