#pragma once

namespace pintle {

/// How C = 0 and Ċ = 0 are enforced.
enum class Constraints {
  projection,   ///< both: explicit schemes project after each step, in the metric of M; implicit ones enforce them in the step
  partitioning  ///< both, in each stage of an explicit scheme: dependent coordinates follow from the independent ones
};

}  // namespace pintle
