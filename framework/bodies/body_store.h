#pragma once

#include <atomic>
#include <cstddef>
#include <optional>

#include "framework/bodies/body_reduction.h"
#include "framework/common/made_once.h"

namespace pintle {

/// Finished bodies of elements, and their reductions, for many scenes in any number of threads: results for the same content (body_key.h)
/// are computed once, and are identical to the bit to those computed without the store.
class BodyStore {
 public:
  /// @param most_bytes  approximate limit of the stored data; the least recently used data are dropped
  explicit BodyStore(std::size_t most_bytes = std::size_t{256} << 20);

  /// As elastic_body. A body whose drawing depends on other data is made again.
  ElasticBody elastic(const Scene&, const SceneBody&);
  /// As reduction_of. For a body that is not from this store it is computed again.
  Reduction reduction(const Scene&, const ElasticBody&, std::optional<int> chosen);

  long bodies_made() const { return bodies_made_; }
  long reductions_made() const { return reductions_made_; }

 private:
  MadeOnce<ElasticBody> bodies_;
  MadeOnce<Reduction> reductions_;
  std::atomic<long> bodies_made_ = 0, reductions_made_ = 0;
};

}  // namespace pintle
