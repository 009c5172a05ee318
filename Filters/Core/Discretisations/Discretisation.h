#ifndef dmgDiscretisation_h
#define dmgDiscretisation_h

#include "Discretisations/Constraints/FieldConstraints.h"
#include "Discretisations/DiscretisationOptions.h"
#include "Levels/ProlongationOperators.h"
#include "Levels/SampledLevels.h"
#include "Mesh/FramedMesh.h"
#include "Mesh/VertexConnection.h"
#include "Solvers/Multigrid/StiffnessHierarchy.h"
#include "Solvers/SolverOptions.h"
#include "Support/ExecutionContext.h"
#include "Support/Remedy.h"
#include "Support/Types.h"

#include <memory>
#include <string>
#include <vector>

namespace dmg
{

class VertexDiscretisation;

/// The elements of a surface that hold values.
enum class ElementKind
{
  Vertices,
  Edges, ///< values are integrals in the edge's orientation, and change their sign with it
  Faces,
};

/// A field as N-th powers, to be drawn: of the faces in their frames and of the vertices in theirs.
struct FieldPowers
{
  Vector<Complex> Faces;
  Vector<Complex> Vertices;
};

/// Numbers that a field has on elements, to be shown beside its directions.
struct ElementValues
{
  std::string Name;
  ElementKind On;
  int Components;
  Vector<double> Values;
};

/// The prolongations that multigrid's coarse spaces come from.
enum class CoarseSpaceKind
{
  /// Vectors, or values of functions, at samples or at vertices of coarse levels, whatever the fine level holds; the
  /// fast one.
  LinearInterpolation,
  /// The thesis's, which keep structure: S0, S1, SX or SP.
  StructurePreserving,
};

/// The linear prolongations of a surface, for a reader that frees their memory as early as it may.
class LinearProlongations
{
public:
  /// Prolongations that others need after the reader. Forget does nothing.
  static LinearProlongations Borrowed(const ProlongationOperators& operators) { return { operators, nullptr }; }
  /// Prolongations that nobody needs after the reader. Forget frees them.
  static LinearProlongations Owned(ProlongationOperators& operators) { return { operators, &operators }; }

  /// Finest first; not empty.
  const std::vector<TransportOperator>& All() const { return this->Operators.Linear; }
  /// These prolongations, and the other operators made with them.
  const ProlongationOperators& Whole() const { return this->Operators; }
  /// Says that they have been read.
  void Forget() const
  {
    if (this->ToForget)
    {
      this->ToForget->Linear.clear();
    }
  }

private:
  LinearProlongations(const ProlongationOperators& operators, ProlongationOperators* toForget)
    : Operators(operators)
    , ToForget(toForget)
  {
  }

  const ProlongationOperators& Operators;
  ProlongationOperators* const ToForget;
};

/// A way to represent fields on a surface by numbers, and everything that set-up, solvers and output ask about it.
/// Whatever differs between discretisations is an answer of such an object; nothing else asks which one it is.
/// A further one is a further subclass and a line in MakeDiscretisation.
///
/// A field minimises its smoothness energy x^T R x plus penalties on prescribed unknowns (HarmonicProblem). R depends on the surface
/// alone.
class Discretisation
{
public:
  /// \param surface is borrowed.
  explicit Discretisation(const FramedMesh& surface)
    : Surface(surface)
  {
  }
  virtual ~Discretisation() = default;
  Discretisation(const Discretisation&) = delete;
  Discretisation& operator=(const Discretisation&) = delete;

  /// The name in words, plural, with the options that count.
  virtual std::string Name() const = 0;

  // Unknowns: UnknownsPerElement() consecutive numbers for each element. -------------------------

  virtual ElementKind Elements() const = 0;
  virtual int UnknownsPerElement() const = 0;
  int NumberOfElements() const;
  int NumberOfUnknowns() const { return this->UnknownsPerElement() * this->NumberOfElements(); }
  /// Rows of the system; fewer than unknowns where these are the parts of complex numbers.
  virtual int NumberOfEquations() const { return this->NumberOfUnknowns(); }
  /// Directions per point.
  virtual int DirectionsPerPoint() const { return 1; }
  /// This, where unknowns stand at vertices; else null. Only such fields are solved for in pieces (FieldSolverInPieces).
  virtual const VertexDiscretisation* AtVertices() const { return nullptr; }

  // The smoothness energy and its solvers. ---------------------------------------------------------------

  /// The inner product that errors are measured in: a positive diagonal, one entry per equation.
  virtual Vector<double> Mass(const ExecutionContext& context) const = 0;
  /// Squared, in that product, the norm of a field of magnitude 1.
  virtual double SquaredNormOfUnit(const Vector<double>& mass) const
  {
    return mass.sum() * this->NumberOfElements() / this->NumberOfEquations();
  }
  /// Whether an unconstrained component gets the eigenvector of the lowest eigenvalue; otherwise the field is zero there.
  virtual bool HasSmoothest() const { return true; }

  /// Whether solutions converge to those of the continuous energy on triangles that are sheared alike.
  virtual bool IsAccurateOnShearedTriangles() const { return true; }

  /// The multigrid that suits this discretisation best, with stiffness and penalties apart.
  virtual std::unique_ptr<const StiffnessHierarchy> Coarsen(
    const LinearProlongations& linear, const ExecutionContext& context) const = 0;

  /// R as a matrix, with prolongations from coarse spaces of either kind.
  /// \param operators of the surface; null: there are no coarse levels, and R is to be factored.
  /// \throw InvalidInput the operators lack those that are needed.
  virtual std::unique_ptr<const StiffnessHierarchy> Assemble(
    const ProlongationOperators* operators, CoarseSpaceKind space, const ExecutionContext& context) const = 0;

  /// The structure-preserving operators that Assemble needs.
  virtual OperatorSelection StructurePreservingOperators() const = 0;
  /// The name of what the levels of these hold.
  virtual std::string NameOfLevels() const = 0;
  /// The default linear levels of this surface, from samples of the elements that unknowns stand on; by default of faces.
  virtual ProlongationOperators SampledLevels(double distance, const ExecutionContext& context) const;
  /// The distance between samples of the first linear level; see SampledLevels.
  virtual double SampleDistance() const { return DefaultSampleDistance; }
  virtual SolverTuning Tuning() const = 0;

  // The kernel of the smoothness energy: harmonic fields, around handles and holes. ------------------------

  /// Whether there are such fields on some surfaces.
  virtual bool HasHarmonicFields() const { return false; }
  /// Their dimension on this surface.
  virtual int NumberOfHarmonicFields() const { return 0; }
  /// A basis of them, a column each, orthonormal in the Euclidean product.
  /// \param operators of the surface, which help where they have S1; may be null.
  virtual Eigen::MatrixXd HarmonicFields(const ProlongationOperators* operators, const ExecutionContext& context) const;
  /// A basis that is orthonormal in the integral over the surface, from any basis.
  virtual Eigen::MatrixXd HarmonicBasis(Eigen::MatrixXd basis, const ExecutionContext& context) const;

  // Constraints. -----------------------------------------------------------------------------------

  /// \param names says how messages call vertices and faces.
  /// \throw InvalidInput a direction is out of range, not finite, perpendicular to the surface, or its weight is
  ///   not positive; or nothing is prescribed, and there is no smoothest field.
  virtual FieldConstraints Prescribe(const Constraints& constraints, const ElementNames& names) const = 0;
  /// Makes the means of a solution zero where it is free by a constant (FieldConstraints::Pinned).
  virtual void CentreFree(const FieldConstraints&, Vector<double>&) const {}
  /// The penalties m_b, weights included.
  /// \throw InvalidInput a weight is out of range.
  Penalties PenaltiesOf(
    const FieldConstraints& constraints, const FieldWeights& weights, const ExecutionContext& context) const;

  // Drawing. ---------------------------------------------------------------------------------------

  /// \param corners of the surface; see Corners.
  virtual FieldPowers Powers(
    const Vector<double>& unknowns, const Unfilled<Corner>& corners, const ExecutionContext& context) const = 0;
  /// The connection that carries powers between vertices, where these are the unknowns: singularities then stand on faces.
  /// Null: the field is drawn as one that is constant on faces, with singularities at vertices.
  virtual const VertexConnection* ConnectionOfPowers(const ExecutionContext&) const { return nullptr; }
  /// \param powers of the same field.
  virtual std::vector<ElementValues> Values(const Vector<double>& unknowns, const FieldPowers& powers) const = 0;
  /// The vectors of a field of one direction, #F x 3.
  /// \pre DirectionsPerPoint() == 1
  virtual Points VectorsOnFaces(const Vector<double>& unknowns, const ExecutionContext& context) const = 0;

  /// Weights of constraints on all faces, or at all vertices, by which penalties are the integral of |X - Y|^2 where the stiffness
  /// is that of |grad X|^2.
  struct IntegralWeights
  {
    double OnFaces;
    double AtVertices;
  };
  virtual IntegralWeights WeightsOfIntegral() const = 0;

protected:
  /// The penalty of a prescribed element of weight 1, where the alignment weight is 1; one per element of the
  /// constraints.
  virtual Vector<double> PenaltiesOfElements(
    const std::vector<int>& elements, const ExecutionContext& context) const = 0;

  /// \param remedy makes them.
  /// \throw InvalidInput they are not there.
  static void CheckOperators(bool areThere, Remedy remedy);

  const FramedMesh& Surface;
};

}

#endif
