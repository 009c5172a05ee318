#ifndef dmgTestSurfaceProblem_h
#define dmgTestSurfaceProblem_h

#include "Discretisations/Levels/LeastSquaresLevels.h"
#include "Operators/ExteriorCalculus.h"
#include "Operators/FaceFieldOperators.h"
#include "Solvers/LeastSquares/LeastSquaresHierarchy.h"
#include "StructurePreserving/SurfaceHierarchy.h"
#include "Support/FieldSystems.h"
#include "Support/MeshFactory.h"
#include "Support/Permutations.h"
#include "Support/Random.h"

#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dmg::test
{

/// Face fields or 1-forms on a surface: a smoothness energy |B x|^2 with real levels, since they are what
/// hierarchies of least squares are for.
struct SurfaceProblem
{
  enum class Of
  {
    FaceFields,
    OneForms
  };

  SurfaceProblem(const Surface& surface, Of kind)
    : Kind(kind)
    , Mesh(surface.Mesh())
    , Frames(FaceFrames(this->Mesh))
  {
    const SerialContext context;
    HierarchyOptions options;
    options.MinimumNumberOfFaces = 60;
    const ProlongationOperators operators =
      BuildSurfaceHierarchy(this->Mesh, options, context, { false, false, false }).Operators;
    const bool isForm = kind == Of::OneForms;
    this->B = isForm ? OneFormLaplacianFactor(this->Mesh, context)
                     : FaceFieldSmoothnessFactor(this->Mesh, this->Frames, context);
    this->Levels = isForm ? LinearLevelsOfOneForms(this->Mesh, this->Frames, operators.Linear, context)
                          : LinearLevelsOfFaceFields(this->Mesh, operators.Linear, context);
  }

  int Size() const { return static_cast<int>(this->B.cols()); }

  LeastSquaresHierarchy Hierarchy(
    const LeastSquaresHierarchyOptions& options = {}, const ExecutionContext& context = SerialContext()) const
  {
    return CoarsenLeastSquares(this->B, this->Levels, options, context);
  }

  /// Faces or edges first, first + step, ... with random weights.
  Penalties Prescribed(int step, ConstraintKind kind, int first = 0) const
  {
    const auto [elements, weights] = this->Elements(step, first);
    const FieldWeights all = { 1.0, 1.0, kind };
    return this->Kind == Of::OneForms ? PenaltiesOfEdges(this->Mesh, { elements, weights }, all)
                                      : PenaltiesOfFaces(this->Mesh, { elements, weights }, all);
  }

  /// The system of the same; its matrix does not come from B.
  HarmonicSystem<double> System(int step, ConstraintKind kind, int first = 0) const
  {
    const auto [elements, weights] = this->Elements(step, first);
    const FieldWeights all = { 1.0, 1.0, kind };
    return this->Kind == Of::OneForms ? MakeOneFormSystem(this->Mesh, { elements, weights }, all)
                                      : MakeFaceFieldSystem(this->Mesh, this->Frames, { elements, weights }, all);
  }

  Of Kind;
  TriangleMesh Mesh;
  TangentFrames Frames;
  SparseMatrix<double> B;
  LeastSquaresLevels Levels;

private:
  std::pair<std::vector<int>, std::vector<double>> Elements(int step, int first) const
  {
    Random random(3420 + step);
    const int size = this->Kind == Of::OneForms ? this->Mesh.NumberOfEdges() : this->Mesh.NumberOfFaces();
    std::vector<int> elements;
    std::vector<double> weights;
    for (int i = first; i < size; i += step)
    {
      elements.push_back(i);
      weights.push_back(random.Uniform(0.5, 2.0));
    }
    return { elements, weights };
  }
};

inline constexpr SurfaceProblem::Of BothKinds[] = { SurfaceProblem::Of::FaceFields, SurfaceProblem::Of::OneForms };

inline std::string NameOf(SurfaceProblem::Of kind)
{
  return kind == SurfaceProblem::Of::FaceFields ? "face fields" : "1-forms";
}

/// R + D.
inline std::unique_ptr<const StiffnessOperator> OperatorOf(const StiffnessHierarchy& hierarchy, const Vector<double>& D)
{
  auto A = hierarchy.Operator();
  A->SetDiagonal(D, SerialContext());
  return A;
}

/// What a prescription adds to B^T B in the order of a hierarchy; infinite where it is hard.
inline Vector<double> DiagonalOf(const LeastSquaresHierarchy& hierarchy, const Penalties& prescribed)
{
  const std::vector<int> places = dmg::Inverse(hierarchy.Order);
  Vector<double> D = Vector<double>::Zero(hierarchy.NumberOfUnknowns());
  for (std::size_t k = 0; k < prescribed.Unknowns.size(); ++k)
  {
    D[places[prescribed.Unknowns[k]]] =
      prescribed.Kind == ConstraintKind::Hard ? std::numeric_limits<double>::infinity() : prescribed.Alignment[k];
  }
  return D;
}

/// Zero where D is infinite.
inline Vector<double> WithoutHeld(Vector<double> x, const Vector<double>& D)
{
  for (Eigen::Index i = 0; i < D.size(); ++i)
  {
    if (D[i] == std::numeric_limits<double>::infinity())
    {
      x[i] = 0.0;
    }
  }
  return x;
}

}

#endif
