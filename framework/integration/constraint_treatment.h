#pragma once

namespace pintle {

/// How C = 0 and Ċ = 0 are enforced.
enum class Constraints {
  projection,   ///< both: after each explicit step by projection in the metric of M; in each implicit step
  partitioning  ///< both, in each stage of an explicit scheme: dependent coordinates follow from the independent ones
};

}  // namespace pintle
