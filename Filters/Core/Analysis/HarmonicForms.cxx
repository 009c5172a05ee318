#include "Analysis/HarmonicForms.h"

#include "Analysis/TreeCotree.h"
#include "Mesh/FaceProjection.h"
#include "Operators/ExteriorCalculus.h"
#include "Operators/FaceFieldOperators.h"
#include "Solvers/Direct/CholeskySolver.h"

#include <Eigen/QR>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <vector>

namespace dmg
{

namespace
{

/// Calls visit(k) for each column of \p columns, in all threads.
template <class Visit>
void ForColumns(const Eigen::MatrixXd& columns, const ExecutionContext& context, const Visit& visit)
{
  context.ParallelFor(0, static_cast<int>(columns.cols()), 1,
    [&visit](int first, int last)
    {
      for (int k = first; k < last; ++k)
      {
        visit(k);
      }
    });
}

Eigen::MatrixXd Orthonormal(const Eigen::MatrixXd& columns)
{
  if (columns.cols() == 0)
  {
    return columns;
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
  return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), columns.cols());
}

/// Gives degenerate faces what has the least energy beside the other faces: a form tells the part along their longest side
/// only, but a field crosses them.
void FillDegenerateFaces(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, Eigen::MatrixXd& fields, const ExecutionContext& context)
{
  std::vector<int> unknowns;
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    if (IsDegenerate(ProjectionOntoSides(mesh, faceFrames, face)))
    {
      unknowns.push_back(2 * face);
      unknowns.push_back(2 * face + 1);
    }
  }
  if (unknowns.empty())
  {
    return;
  }
  const int size = static_cast<int>(unknowns.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < size; ++k)
  {
    entries.emplace_back(unknowns[k], k, 1.0);
  }
  Eigen::SparseMatrix<double> insert(fields.rows(), size);
  insert.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseMatrix<double> B = FaceFieldSmoothnessFactor(mesh, faceFrames, context);
  const Eigen::SparseMatrix<double> ofUnknowns = B * insert;
  const Eigen::SparseMatrix<double> normal = ofUnknowns.transpose() * ofUnknowns;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(normal);
  if (factor.info() == Eigen::Success)
  {
    fields -= insert * Eigen::MatrixXd(factor.solve(ofUnknowns.transpose() * (B * fields)));
  }
}

}

int NumberOfGenerators(const TriangleMesh& mesh)
{
  const std::vector<int> components = FaceComponents(mesh);
  std::vector<char> isClosed; // by component
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    isClosed.resize(std::max<std::size_t>(isClosed.size(), components[face] + 1), 1);
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      isClosed[components[face]] &= mesh.Twin(h) >= 0;
    }
  }
  // Every edge beyond a spanning tree of the vertices and a spanning tree of the faces makes a generator. On a surface
  // with boundary, the root of the faces' tree stands for all that lies beyond the boundary.
  const auto numberOfTrees = static_cast<int>(isClosed.size());
  const auto numberOfClosed = static_cast<int>(std::count(isClosed.begin(), isClosed.end(), 1));
  return mesh.NumberOfEdges() - (mesh.NumberOfVertices() - numberOfTrees) - (mesh.NumberOfFaces() - numberOfClosed);
}

bool AreTooManyToHold(int generators, const TriangleMesh& mesh)
{
  constexpr double LargestNumberOfValues = 5e7;
  return static_cast<double>(generators) * mesh.NumberOfFaces() > LargestNumberOfValues;
}

Eigen::MatrixXd ClosedForms(const TriangleMesh& mesh, const ExecutionContext& context)
{
  const TreeCotree trees = MakeTreeCotree(mesh, BoundaryAs::Face);
  Eigen::MatrixXd forms = Eigen::MatrixXd::Zero(mesh.NumberOfEdges(), static_cast<int>(trees.Generators.size()));
  const auto close = [&mesh, &trees](auto&& form)
  {
    for (std::size_t i = trees.Faces.size(); i-- > 0;)
    {
      const int face = trees.Faces[i];
      const int toParent = trees.ParentHalfedges[face];
      if (toParent < 0)
      {
        continue;
      }
      double sum = 0.0;
      for (int h = 3 * face; h < 3 * face + 3; ++h)
      {
        sum += h == toParent ? 0.0 : mesh.EdgeSign(h) * form[mesh.EdgeOf(h)];
      }
      form[mesh.EdgeOf(toParent)] = -sum * mesh.EdgeSign(toParent);
    }
  };
  ForColumns(forms, context,
    [&](int k)
    {
      forms(trees.Generators[k], k) = 1.0;
      close(forms.col(k));
    });
  return forms;
}

Eigen::MatrixXd ProlongedClosedForms(const ProlongationOperators& operators, const ExecutionContext& context)
{
  const SparseMatrix<double>& coarse = operators.ClosedForms;
  Eigen::MatrixXd forms(operators.NumbersOfEdges.front(), coarse.cols());
  ForColumns(forms, context,
    [&](int k)
    {
      Vector<double> form = coarse.col(k);
      for (std::size_t level = operators.S1.size(); level-- > 0;)
      {
        form = operators.S1[level] * form;
      }
      forms.col(k) = form;
    });
  return forms;
}

namespace
{

/// Takes gradients away from closed forms, a column each, until they have no divergence.
/// \param star of 1-forms.
Eigen::MatrixXd WithoutDivergence(
  const TriangleMesh& mesh, Eigen::MatrixXd forms, const Vector<double>& star, const ExecutionContext& context)
{
  if (forms.cols() == 0)
  {
    return forms;
  }
  const SparseMatrix<double> d0 = D0(mesh, context);
  const SparseMatrix<double> divergence = SparseMatrix<double>(d0.transpose()) * star.asDiagonal();
  SparseMatrix<double> laplacian = divergence * d0;
  // Constants are the kernel; a little of the diagonal makes it definite, and the corrections below undo it. Slivers have
  // entries so large that a part of them would be too much.
  constexpr double LargestEntry = 1e5;
  const double shift = 1e-10 * std::min(LargestEntry, laplacian.diagonal().cwiseAbs().maxCoeff());
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    laplacian.coeffRef(vertex, vertex) += shift;
  }
  laplacian.makeCompressed();
  context.Checkpoint(0.1);
  CholeskySolver<double> solver(laplacian);
  constexpr int Corrections = 3;
  Eigen::MatrixXd divergences(mesh.NumberOfVertices(), forms.cols());
  Eigen::MatrixXd potentials;
  for (int correction = 0; correction < Corrections; ++correction)
  {
    context.Checkpoint(0.5 + 0.4 * correction / Corrections);
    ForColumns(forms, context, [&](int k) { divergences.col(k) = divergence * forms.col(k); });
    solver.Solve(divergences, potentials);
    ForColumns(forms, context, [&](int k) { forms.col(k) -= d0 * potentials.col(k); });
  }
  context.Checkpoint(0.9);
  return Orthonormal(forms);
}

/// Closed forms that are no gradients, one for each generator.
Eigen::MatrixXd FormsOfGenerators(
  const TriangleMesh& mesh, const ExecutionContext& context, const ProlongationOperators* operators)
{
  const bool areProlonged = operators && !operators->S1.empty() && operators->ClosedForms.cols() > 0;
  return areProlonged ? ProlongedClosedForms(*operators, context) : ClosedForms(mesh, context);
}

}

Eigen::MatrixXd HarmonicForms(
  const TriangleMesh& mesh, const ExecutionContext& context, const ProlongationOperators* operators)
{
  return WithoutDivergence(mesh, FormsOfGenerators(mesh, context, operators), Star1(mesh), context);
}

Eigen::MatrixXd HarmonicFaceFields(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const ExecutionContext& context, const ProlongationOperators* operators)
{
  const Eigen::MatrixXd forms =
    WithoutDivergence(mesh, FormsOfGenerators(mesh, context, operators), Star1OfFaceFields(mesh), context);
  if (forms.cols() == 0)
  {
    return Eigen::MatrixXd(2 * mesh.NumberOfFaces(), 0);
  }
  Eigen::MatrixXd alongHalfedges(3 * mesh.NumberOfFaces(), forms.cols());
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    alongHalfedges.row(h) = mesh.EdgeSign(h) * forms.row(mesh.EdgeOf(h));
  }
  Eigen::MatrixXd fields = HalfedgePseudoInverse(mesh, faceFrames, context) * alongHalfedges;
  FillDegenerateFaces(mesh, faceFrames, fields, context);
  return Orthonormal(fields);
}

}
