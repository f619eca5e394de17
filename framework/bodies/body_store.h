#pragma once

#include <atomic>
#include <cstddef>
#include <optional>

#include "framework/bodies/body_reduction.h"
#include "framework/common/made_once.h"

namespace pintle {

/// Finished bodies of elements, and their reductions, for many scenes in any number of threads: what follows from the same
/// content (body_key.h) is made once, and what comes out of the store is to the bit what would be made without it.
class BodyStore {
 public:
  /// @param most_bytes  of what is kept, about; what was used least recently goes
  explicit BodyStore(std::size_t most_bytes = std::size_t{256} << 20);

  /// As elastic_body. A body whose drawing depends on more than itself is made again.
  ElasticBody elastic(const Scene&, const SceneBody&);
  /// As reduction_of. Of a body that is not from here it is made again.
  Reduction reduction(const Scene&, const ElasticBody&, std::optional<int> chosen);

  long bodies_made() const { return bodies_made_; }
  long reductions_made() const { return reductions_made_; }

 private:
  MadeOnce<ElasticBody> bodies_;
  MadeOnce<Reduction> reductions_;
  std::atomic<long> bodies_made_ = 0, reductions_made_ = 0;
};

}  // namespace pintle
