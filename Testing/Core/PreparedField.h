#ifndef dmgTestPreparedField_h
#define dmgTestPreparedField_h

#include "Discretisations/VertexPowerField.h"
#include "PreparedSurface.h"
#include "Support/FieldProblem.h"
#include "Support/FieldSystems.h"
#include "Support/Random.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace dmg::test
{

/// Whose smoothness energy is a sum of squares.
inline constexpr DiscretisationKind Squares[] = { DiscretisationKind::FaceField, DiscretisationKind::OneForm };
inline constexpr ConstraintKind BothConstraints[] = { ConstraintKind::Soft, ConstraintKind::Hard };

inline FieldOptions OptionsOf(DiscretisationKind kind, SolverKind solver = SolverKind::ConjugateGradients)
{
  FieldOptions options;
  options.Field.Kind = kind;
  options.Solver.Kind = solver;
  return options;
}

/// Prescribed elements with their weights.
struct Elements
{
  std::vector<int> Numbers;
  std::vector<double> Weights;
};

/// A discretisation on a surface, for cycles and for a factorisation.
struct PreparedField
{
  PreparedField(const Surface& surface, DiscretisationKind kind)
    : Kind(kind)
    , Owned(std::make_shared<const FramedMesh>(surface.Mesh()))
  {
    this->Operators = BuildSurfaceHierarchy(this->Mesh, Deep(), SerialContext(), { false, false, false }).Operators;
    this->Levels = SetupOf(this->Framed, &this->Operators, OptionsOf(kind), SerialContext());
  }

  bool IsForm() const { return this->Kind == DiscretisationKind::OneForm; }
  bool IsAtVertices() const { return this->Kind == DiscretisationKind::VertexPowerField; }
  int NumberOfElements() const
  {
    return this->IsForm()    ? this->Mesh.NumberOfEdges()
      : this->IsAtVertices() ? this->Mesh.NumberOfVertices()
                             : this->Mesh.NumberOfFaces();
  }
  int NumberOfUnknowns() const { return this->UnknownsPerElement() * this->NumberOfElements(); }
  int UnknownsPerElement() const { return this->IsForm() ? 1 : 2; }

  /// Elements first, first + step, ... below \p last, with random weights.
  Elements Every(int step, int first = 0, int last = 1 << 30) const
  {
    Random random(3700 + step);
    Elements elements;
    for (int i = first; i < std::min(last, this->NumberOfElements()); i += step)
    {
      elements.Numbers.push_back(i);
      elements.Weights.push_back(random.Uniform(0.5, 2.0));
    }
    return elements;
  }

  Penalties Prescribed(const Elements& elements, const FieldWeights& weights) const
  {
    if (this->IsAtVertices())
    {
      return VertexPowerField(this->Framed, 4)
        .PenaltiesOf({ elements.Numbers, elements.Weights, {} }, weights, SerialContext());
    }
    // The areas of faces pull at powers as they do at vectors.
    return this->IsForm() ? PenaltiesOfEdges(this->Mesh, { elements.Numbers, elements.Weights }, weights)
                          : PenaltiesOfFaces(this->Mesh, { elements.Numbers, elements.Weights }, weights);
  }

  HarmonicProblem Problem(
    const Elements& elements, const FieldWeights& weights, SolverKind solver = SolverKind::ConjugateGradients) const
  {
    return HarmonicProblem(this->Levels, this->Prescribed(elements, weights), weights.Smoothness, {},
      { &MethodOf(solver), "" }, SerialContext());
  }

  /// The same by factoring the matrix of the system, which is assembled otherwise.
  FieldProblem Factored(const Elements& elements, const FieldWeights& weights) const
  {
    FieldOptions options = OptionsOf(this->Kind, SolverKind::Cholesky);
    options.Smoothness = weights.Smoothness;
    options.Alignment = weights.Alignment;
    options.Constraints = weights.Constraints;
    return FieldProblem(this->Framed, nullptr, { elements.Numbers, elements.Weights, {} }, options, SerialContext());
  }

  Vector<double> RandomValues(const Elements& elements, unsigned seed) const
  {
    Random random(seed);
    Vector<double> values(this->UnknownsPerElement() * elements.Numbers.size());
    for (double& value : values)
    {
      value = random.Uniform(-1.0, 1.0);
    }
    return values;
  }

  FieldConstraints Constraints(const Elements& elements, unsigned seed) const
  {
    return { elements.Numbers, elements.Weights, this->RandomValues(elements, seed) };
  }

  const DiscretisationKind Kind;
  const std::shared_ptr<const FramedMesh> Owned;
  const FramedMesh& Framed = *this->Owned;
  const TriangleMesh& Mesh = this->Framed.Mesh;
  const TangentFrames& Frames = this->Framed.Faces;
  ProlongationOperators Operators;
  std::shared_ptr<const MultigridSetup> Levels;
};

inline std::string Describe(DiscretisationKind kind, ConstraintKind constraints)
{
  const bool isFace = kind == DiscretisationKind::FaceField;
  const bool isAtVertices = kind == DiscretisationKind::VertexPowerField;
  const std::string powers = isAtVertices ? "powers at vertices" : "powers";
  const std::string name = kind == DiscretisationKind::OneForm ? "1-form" : isFace ? "face field" : powers;
  return name + (constraints == ConstraintKind::Soft ? ", soft" : ", hard");
}

}

#endif
