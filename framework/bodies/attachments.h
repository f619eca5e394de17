#pragma once

#include <vector>

#include "framework/bodies/elastic_body.h"
#include "framework/bodies/load_history.h"
#include "framework/dynamics/equations/equations.h"

/// Points where joints, drivers and forces act on bodies of elements, and their loads there.
namespace pintle {

/// Indices of the elements of a scene in its system.
struct BuiltOrder {
  std::vector<int> joints;    ///< of each joint of the scene: into System::joints, for one with clearance into System::contacts
  std::vector<int> drivers;   ///< into System::joints
  std::vector<int> loads;     ///< into System::forces
  std::vector<int> contacts;  ///< into System::contacts, the first pair of each
};

/// Point where a joint, a contact or a force acts on a body of elements. Its wrench is that of the k-th joint or force, or of the k-th
/// contact (for profiles, the sum over all pairs from the k-th on).
struct Attachment {
  enum Of { joint, contact, force } of;
  std::size_t k;
  std::size_t end;  ///< index of the marker: a, b, … or journal, bearing
  std::size_t body;
  Eigen::Index row;  ///< of the load history
};

/// All attachments to the bodies in `elements`, which has one entry per body of the scene, nullptr for others.
std::vector<Attachment> attachments_of(const Scene&, const BuiltOrder&, const std::vector<const ElasticBody*>& elements);

/// Factor of each of `loads_on` for body b in an evaluated state: a column of its LoadHistory, whose size `out` has.
void loads_now(const System&, const std::vector<Attachment>&, const State&, const Equations&, std::size_t b,
               Eigen::Ref<Eigen::VectorXd> out);

}  // namespace pintle
