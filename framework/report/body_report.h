#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "eigen_layout.h"
#include "framework/report/run_report.h"

namespace pintle {

struct ElasticBody;
struct StressField;

/// The contents of drawing.json, from which a page draws the body: its mesh and its shapes.
/// @param shapes  of each a column of displacements in the degrees of freedom of the body   @param stress  of the only shape; nullptr: without
std::string body_drawing(const ElasticBody&, const Eigen::MatrixXd& shapes, const StressField* stress = nullptr);

/// The page of the `modes` or the `static` case of a body; nothing if the folder has no drawing.json of one. @throws ResultsError
std::optional<std::string> body_page(const std::filesystem::path& directory, const ReportLimits&);

}  // namespace pintle
