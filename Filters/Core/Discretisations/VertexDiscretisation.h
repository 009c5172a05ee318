#ifndef dmgVertexDiscretisation_h
#define dmgVertexDiscretisation_h

#include "Discretisations/Constraints/VertexConstraints.h"
#include "Discretisations/Discretisation.h"

#include <vector>

namespace dmg
{

/// A discretisation with one unknown per vertex, real or complex, that is linear between them. The equation of a vertex depends on the
/// faces around it, so a part of a surface has the equations of its inner vertices; see FieldSolverInPieces.
///
/// Numbers are complex here, and those of real unknowns have no imaginary part.
class VertexDiscretisation : public Discretisation
{
public:
  /// Between samples of vertices, which the linear levels hold; see SampledLevels.
  static constexpr double DistanceOfSamples = 2.5;

  using Discretisation::Discretisation;

  ElementKind Elements() const override { return ElementKind::Vertices; }
  int NumberOfEquations() const override { return this->NumberOfElements(); }
  const VertexDiscretisation* AtVertices() const override { return this; }

  /// The area of each vertex. Mass is the same up to a factor.
  virtual Vector<double> AreasOfVertices(const ExecutionContext& context) const = 0;
  /// R, a row per vertex.
  virtual SparseMatrix<Complex> Stiffness(const ExecutionContext& context) const = 0;
  /// The prolongation of unknowns where \p transport prolongs directions.
  virtual SparseMatrix<Complex> ProlongationOfUnknowns(
    const TransportOperator& transport, const ExecutionContext& context) const = 0;
  /// The constraints at each vertex of the mesh, summed up; those that Prescribe averages.
  /// \param isSurrounded SurroundedVertices, which counts where directions are taken.
  /// \throw InvalidInput a constraint is wrong, as in Prescribe.
  virtual std::vector<PowerAtVertex> SumsAtVertices(
    const Constraints& constraints, const std::vector<char>& isSurrounded, const ElementNames& names) const = 0;
  /// The means of such sums.
  FieldConstraints MeansOf(const std::vector<PowerAtVertex>& sums) const;
  /// Complex numbers as UnknownsPerElement real ones each.
  Vector<double> AsUnknowns(const Vector<Complex>& numbers) const;

  IntegralWeights WeightsOfIntegral() const override;

protected:
  Vector<double> PenaltiesOfElements(const std::vector<int>& vertices, const ExecutionContext& context) const override;
};

}

#endif
