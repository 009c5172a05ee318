#include "Support/Identities.h"

#include "Directions/PowerFieldDirections.h"
#include "Operators/ExteriorCalculus.h"
#include "Support/DenseAlgebra.h"
#include "Support/Random.h"
#include "Support/ReferenceOperators.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>

#include <algorithm>
#include <cmath>

namespace dmg::test
{

double RowSumResidual(const SparseMatrix<double>& S)
{
  const Vector<double> sums = S * Vector<double>::Ones(S.cols());
  return (sums.array() - 1.0).abs().maxCoeff();
}

double SmallestEntry(const SparseMatrix<double>& S)
{
  return S.nonZeros() > 0 ? S.coeffs().minCoeff() : 0.0;
}

double RelativeDifference(const SparseMatrix<Complex>& A, const SparseMatrix<Complex>& B)
{
  const SparseMatrix<Complex> difference = A - B;
  return difference.coeffs().abs().maxCoeff() / B.coeffs().abs().maxCoeff();
}

double HermitianResidual(const SparseMatrix<Complex>& A)
{
  return RelativeDifference(SparseMatrix<Complex>(A.adjoint()), A);
}

double RelativeDifference(const Vector<Complex>& a, const Vector<Complex>& b)
{
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

double RelativeDifference(const SparseMatrix<double>& A, const SparseMatrix<double>& B)
{
  const SparseMatrix<double> difference = A - B;
  return difference.coeffs().abs().maxCoeff() / B.coeffs().abs().maxCoeff();
}

double RelativeDifference(const Vector<double>& a, const Vector<double>& b)
{
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

double DerivativeTwiceResidual(const TriangleMesh& mesh)
{
  const SparseMatrix<double> product = D1(mesh) * D0(mesh);
  return product.coeffs().abs().maxCoeff();
}

double ExactnessResidual(
  const TriangleMesh& fine, const TriangleMesh& coarse, const SparseMatrix<double>& S0, const SparseMatrix<double>& S1)
{
  const SparseMatrix<double> before = D0(fine) * S0;
  const SparseMatrix<double> after = S1 * D0(coarse);
  const SparseMatrix<double> difference = before - after;
  return difference.coeffs().abs().maxCoeff();
}

double ClosednessResidual(const TriangleMesh& fine, const SparseMatrix<double>& S1, const Vector<double>& z)
{
  return (D1(fine) * (S1 * z)).cwiseAbs().maxCoeff() / z.cwiseAbs().maxCoeff();
}

double TotalCurlResidual(const TriangleMesh& fine, const TriangleMesh& coarse, const SparseMatrix<double>& S1)
{
  const Vector<double> fineTotal = D1(fine).transpose() * Vector<double>::Ones(fine.NumberOfFaces());
  const Vector<double> coarseTotal = D1(coarse).transpose() * Vector<double>::Ones(coarse.NumberOfFaces());
  return (S1.transpose() * fineTotal - coarseTotal).cwiseAbs().maxCoeff();
}

double WeakestColumn(const SparseMatrix<double>& S)
{
  Vector<double> largest = Vector<double>::Zero(S.cols());
  for (int row = 0; row < S.rows(); ++row)
  {
    for (SparseMatrix<double>::InnerIterator entry(S, row); entry; ++entry)
    {
      largest[entry.col()] = std::max(largest[entry.col()], std::abs(entry.value()));
    }
  }
  return largest.minCoeff();
}

Vector<double> Eigenvalues(const SparseMatrix<double>& A)
{
  return Eigenvalues(Densified(A));
}

Vector<double> Eigenvalues(const SparseMatrix<Complex>& A)
{
  return Eigenvalues(Densified(A));
}

Vector<double> LowestEigenvalues(const SparseMatrix<Complex>& A, const Vector<double>& M, int count)
{
  using Dense = Eigen::MatrixXcd;
  const Vector<Complex> scale = M.cwiseSqrt().cwiseInverse().cast<Complex>();
  const Eigen::SparseMatrix<Complex> scaled = scale.asDiagonal() * A * scale.asDiagonal();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<Complex>> factor(scaled);
  Random random(1);
  Dense basis(A.rows(), count + 4);
  for (int k = 0; k < basis.cols(); ++k)
  {
    basis.col(k) = random.Numbers(static_cast<int>(A.rows()));
  }
  Vector<double> eigenvalues;
  for (int iteration = 0; iteration < 30; ++iteration)
  {
    basis = Dense(Eigen::HouseholderQR<Dense>(basis).householderQ() * Dense::Identity(basis.rows(), basis.cols()));
    const Eigen::SelfAdjointEigenSolver<Dense> small(basis.adjoint() * (scaled * basis));
    eigenvalues = small.eigenvalues().head(count);
    basis = factor.solve(basis * small.eigenvectors());
  }
  return eigenvalues;
}

Vector<Complex> SolveByLU(const SparseMatrix<Complex>& A, const Vector<Complex>& b)
{
  const Eigen::SparseMatrix<Complex> columns = A;
  Eigen::SparseLU<Eigen::SparseMatrix<Complex>> lu(columns);
  return lu.solve(b);
}

TangentFrames Turned(const TangentFrames& frames, const std::vector<double>& angles)
{
  TangentFrames turned = frames;
  for (std::size_t i = 0; i < angles.size(); ++i)
  {
    const double c = std::cos(angles[i]);
    const double s = std::sin(angles[i]);
    turned.X.row(i) = c * frames.X.row(i) + s * frames.Y.row(i);
    turned.Y.row(i) = c * frames.Y.row(i) - s * frames.X.row(i);
  }
  return turned;
}

Vector<Complex> InTurnedFrames(const Vector<Complex>& powers, const std::vector<double>& angles, int N)
{
  Vector<Complex> turned = powers;
  for (std::size_t i = 0; i < angles.size(); ++i)
  {
    turned[i] *= std::polar(1.0, -N * angles[i]);
  }
  return turned;
}

Unfilled<Corner> CornersOf(const TriangleMesh& mesh)
{
  const TangentFrames frames = FaceFrames(mesh);
  return Corners(mesh, SideDirections(mesh, frames), frames, VertexFrames(mesh));
}

Vector<double> IndicesOf(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const Vector<Complex>& powers, int N)
{
  return SingularityIndices(
    mesh, CornersOf(mesh), MatchDirections(mesh, SideDirections(mesh, faceFrames), powers, N).Rotation, N);
}

Vector<Complex> PowersOfDirection(const TangentFrames& frames, const Vector3& v, int N)
{
  Vector<Complex> powers(frames.X.rows());
  for (int i = 0; i < powers.size(); ++i)
  {
    powers[i] = std::polar(1.0, N * std::arg(frames.ToComplex(i, v)));
  }
  return powers;
}

double LargestEntry(const SparseMatrix<double>& A)
{
  return A.nonZeros() > 0 ? A.coeffs().abs().maxCoeff() : 0.0;
}

double VanishingResidual(const SparseMatrix<double>& A, const SparseMatrix<double>& B)
{
  return LargestEntry(A * B) / (LargestEntry(A) * LargestEntry(B));
}

double CommutationResidual(const SparseMatrix<double>& A, const SparseMatrix<double>& B, const SparseMatrix<double>& C,
  const SparseMatrix<double>& D)
{
  const SparseMatrix<double> expected = C * D;
  const SparseMatrix<double> difference = SparseMatrix<double>(A * B) - expected;
  return LargestEntry(difference) / LargestEntry(expected);
}

Vector<double> FaceFieldOfVector(const TangentFrames& faceFrames, const Vector3& v)
{
  Vector<double> field(2 * faceFrames.X.rows());
  for (int face = 0; face < faceFrames.X.rows(); ++face)
  {
    const Complex z = faceFrames.ToComplex(face, v);
    field.segment<2>(2 * face) << z.real(), z.imag();
  }
  return field;
}

Vector<double> SymmetricEigenvalues(const SparseMatrix<double>& A)
{
  return Eigenvalues(A);
}

}
