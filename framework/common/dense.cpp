#include "framework/common/dense.h"

namespace Eigen {

template void ColPivHouseholderQR<MatrixXd>::computeInPlace();
template void CompleteOrthogonalDecomposition<MatrixXd>::computeInPlace();
template void HouseholderQR<MatrixXd>::computeInPlace();
template void PartialPivLU<MatrixXd>::compute();
template JacobiSVD<MatrixXd>& JacobiSVD<MatrixXd>::compute(const MatrixXd&, unsigned);
template SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&, int);
template EigenSolver<MatrixXd>& EigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&, bool);
template LLT<MatrixXd>& LLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);

}  // namespace Eigen
