#ifndef dmgTestDerivatives_h
#define dmgTestDerivatives_h

#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Support/Types.h"

#include <array>
#include <vector>

/// Derivatives from their definitions, entry by entry, against which prolongations are tested.
namespace dmg::test
{

inline SparseMatrix<double> FromTriplets(int rows, int columns, const std::vector<Eigen::Triplet<double>>& triplets)
{
  SparseMatrix<double> result(rows, columns);
  result.setFromTriplets(triplets.begin(), triplets.end());
  return result;
}

/// d0, #E x #V
inline SparseMatrix<double> DifferencesAlongEdges(const TriangleMesh& mesh)
{
  std::vector<Eigen::Triplet<double>> triplets;
  for (int e = 0; e < mesh.NumberOfEdges(); ++e)
  {
    triplets.emplace_back(e, mesh.EdgeVertices(e)[0], -1.0);
    triplets.emplace_back(e, mesh.EdgeVertices(e)[1], 1.0);
  }
  return FromTriplets(mesh.NumberOfEdges(), mesh.NumberOfVertices(), triplets);
}

/// d1, #F x #E
inline SparseMatrix<double> SumsAroundFaces(const TriangleMesh& mesh)
{
  std::vector<Eigen::Triplet<double>> triplets;
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    triplets.emplace_back(h / 3, mesh.EdgeOf(h), mesh.EdgeSign(h));
  }
  return FromTriplets(mesh.NumberOfFaces(), mesh.NumberOfEdges(), triplets);
}

/// P, 3 #F x 2 #F: values of face fields along halfedges.
inline SparseMatrix<double> ValuesAlongHalfedges(const TriangleMesh& mesh, const TangentFrames& frames)
{
  std::vector<Eigen::Triplet<double>> triplets;
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    const Complex side = frames.ToComplex(h / 3, mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h)));
    triplets.emplace_back(h, 2 * (h / 3), side.real());
    triplets.emplace_back(h, 2 * (h / 3) + 1, side.imag());
  }
  return FromTriplets(3 * mesh.NumberOfFaces(), 2 * mesh.NumberOfFaces(), triplets);
}

/// G, 2 #F x #V: the gradient of a linear function with values u_k at the corners of a face is the
/// sum of u_k times the side opposite to k, turned by a right angle, over twice the area.
inline SparseMatrix<double> Gradients(const TriangleMesh& mesh, const TangentFrames& frames)
{
  std::vector<Eigen::Triplet<double>> triplets;
  for (int f = 0; f < mesh.NumberOfFaces(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int opposite = 3 * f + (k + 1) % 3;
      const Complex turned = Complex(0.0, 1.0) *
        frames.ToComplex(f, mesh.Position(mesh.Head(opposite)) - mesh.Position(mesh.Tail(opposite))) /
        (2.0 * mesh.FaceArea(f));
      triplets.emplace_back(2 * f, mesh.FaceCorners()(f, k), turned.real());
      triplets.emplace_back(2 * f + 1, mesh.FaceCorners()(f, k), turned.imag());
    }
  }
  return FromTriplets(2 * mesh.NumberOfFaces(), mesh.NumberOfVertices(), triplets);
}

inline double LargestDifference(const SparseMatrix<double>& A, const SparseMatrix<double>& B)
{
  const SparseMatrix<double> difference = A - B;
  return difference.nonZeros() == 0 ? 0.0 : difference.coeffs().abs().maxCoeff();
}

}

#endif
