#ifndef dmgTestIdentities_h
#define dmgTestIdentities_h

#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Support/Types.h"

#include <vector>

/// How far an object is from an identity that it ought to satisfy: residuals that tests compare
/// with multiples of the machine precision.
namespace dmg::test
{

constexpr double MachinePrecision = 2.220446049250313e-16;

/// max_i |sum_j S_ij - 1|
double RowSumResidual(const SparseMatrix<double>& S);

/// Smallest stored entry; 0 where there is none.
double SmallestEntry(const SparseMatrix<double>& S);

/// max |A - A^H| over max |A|
double HermitianResidual(const SparseMatrix<Complex>& A);

/// max |A - B| over max |B|
double RelativeDifference(const SparseMatrix<Complex>& A, const SparseMatrix<Complex>& B);

/// max |a - b| over max |b|
double RelativeDifference(const Vector<Complex>& a, const Vector<Complex>& b);

double RelativeDifference(const SparseMatrix<double>& A, const SparseMatrix<double>& B);
double RelativeDifference(const Vector<double>& a, const Vector<double>& b);

/// max |d1 d0|: exactly 0
double DerivativeTwiceResidual(const TriangleMesh& mesh);

/// max |d0 S0 - S1 d0|: exact forms stay exact.
double ExactnessResidual(
  const TriangleMesh& fine, const TriangleMesh& coarse, const SparseMatrix<double>& S0, const SparseMatrix<double>& S1);

/// max |d1 S1 z| over max |z|: closed forms stay closed. \pre z is closed.
double ClosednessResidual(const TriangleMesh& fine, const SparseMatrix<double>& S1, const Vector<double>& z);

/// |1^T d1 S1| over all columns less 1^T d1 of the coarse level: how far the total curl is from being
/// kept.
double TotalCurlResidual(const TriangleMesh& fine, const TriangleMesh& coarse, const SparseMatrix<double>& S1);

/// The least over the columns of the largest entry; 0 where a column is empty.
double WeakestColumn(const SparseMatrix<double>& S);

/// All eigenvalues of a symmetric matrix, ascending. Dense: for some hundred rows.
Vector<double> Eigenvalues(const SparseMatrix<double>& A);

/// All eigenvalues of a Hermitian matrix, ascending. Dense: for some hundred rows.
Vector<double> Eigenvalues(const SparseMatrix<Complex>& A);

/// The lowest eigenvalues of A x = lambda diag(M) x, ascending; A and M positive definite. Subspace
/// iteration on a sparse factorisation; good to about 1e-8 where a gap follows the last one.
Vector<double> LowestEigenvalues(const SparseMatrix<Complex>& A, const Vector<double>& M, int count);

/// The solution of a regular system by a general sparse LU: the second opinion for every solver.
Vector<Complex> SolveByLU(const SparseMatrix<Complex>& A, const Vector<Complex>& b);

/// Frames with X and Y turned about N by an angle per element.
TangentFrames Turned(const TangentFrames& frames, const std::vector<double>& angles);

/// N-powers in frames that were turned: what e^{i N angle} takes from the coordinates.
Vector<Complex> InTurnedFrames(const Vector<Complex>& powers, const std::vector<double>& angles, int N);

/// Corners with the frames that meshes come with.
Unfilled<Corner> CornersOf(const TriangleMesh& mesh);

/// SingularityIndices of powers.
Vector<double> IndicesOf(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const Vector<Complex>& powers, int N);

/// The power of the same direction v in every face: (v . X + i v . Y)^N, of unit magnitude.
Vector<Complex> PowersOfDirection(const TangentFrames& frames, const Vector3& v, int N);

// Face fields --------------------------------------------------------------------------------------

/// max |A_ij|; 0 for an empty matrix.
double LargestEntry(const SparseMatrix<double>& A);

/// max |A B| over max |A| max |B|, for products that ought to vanish.
double VanishingResidual(const SparseMatrix<double>& A, const SparseMatrix<double>& B);

/// max |A B - C D| over max |C D|, for diagrams that ought to commute.
double CommutationResidual(const SparseMatrix<double>& A, const SparseMatrix<double>& B, const SparseMatrix<double>& C,
  const SparseMatrix<double>& D);

/// The same vector in every face, as a face field.
Vector<double> FaceFieldOfVector(const TangentFrames& faceFrames, const Vector3& v);

/// All eigenvalues of a symmetric matrix, ascending. Dense: for some hundred rows.
Vector<double> SymmetricEigenvalues(const SparseMatrix<double>& A);

}

#endif
