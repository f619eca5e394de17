#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/scene/scene.h"

namespace pintle {

/// The pieces that a beam is divided into.
struct Pieces {
  std::vector<SceneBody> bodies;
  std::vector<SceneJoint> welds;
  std::map<std::string, std::string> owner;  ///< for each point, the name of its piece
};

/// Redirects references to a beam or its points to the pieces. @throws SceneError  as with_pieces
class Redirection {
 public:
  Redirection(const Scene& before, const std::map<std::string, Pieces>& cuts) : before_(before), cuts_(cuts) {}

  void redirect(PointRef&) const;
  void redirect(PointRef& a, PointRef& b, const Place&) const;
  void redirect(SceneJoint&) const;
  void redirect(SceneContact&) const;
  void redirect(SceneLoad&) const;
  /// All pieces start as parts of one rigid body and share its axes.
  std::vector<StartBody> starts() const;

 private:
  const ScenePoint& at_origin(const SceneBody&, const PointRef&) const;

  const Scene& before_;
  const std::map<std::string, Pieces>& cuts_;
};

}  // namespace pintle
