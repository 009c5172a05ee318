#ifndef dmgField_h
#define dmgField_h

#include "Constraints/Guides.h"
#include "Constraints/SurfaceFeatures.h"
#include "Discretisations/Discretisation.h"
#include "Mesh/FramedMesh.h"
#include "Setup/FieldSolution.h"
#include "Solvers/Krylov/SolveReport.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <memory>
#include <string>
#include <vector>

namespace dmg
{

/// A field on a surface as N directions on each face and at each vertex, and what it took to find it.
struct Field
{
  int N = 1;                  ///< directions per point
  FieldPowers Powers;         ///< N-th powers
  Vector<Complex> OnFaces;    ///< direction 0 in the frames of faces, of the field's magnitude
  Vector<Complex> AtVertices; ///< the same of vertices
  /// Whether singularities stand on faces rather than at vertices (Discretisation::ConnectionOfPowers).
  bool AreSingularitiesOnFaces = false;
  Vector<double> Indices; ///< of the singularity on each of these elements, multiples of 1 / N
  /// Across each edge, from the face of its halfedge to the other one; where singularities stand on faces, along each edge.
  Vector<double> Rotation;
  bool IsCombed = false;     ///< see FieldProblem::Combing
  bool HasUnitLength = true; ///< see FieldProblem::UnitLength; of Directions alone

  SolveReport Report;
  GuidesReport Guides;
  std::vector<SurfaceFeature> Features; ///< of the surface that the field follows
  /// Sentences for the user. Constraints that could not be followed are named each time, warnings of the solver come once.
  std::vector<std::string> Warnings;

  std::shared_ptr<const FieldSolution> Solution;
  /// A basis of the harmonic fields of this kind, around handles and holes: a column each, orthonormal in the integral over the
  /// surface. Null where FieldProblem::HarmonicBasis is off, or fields of this kind have none on any surface. No columns where
  /// there are too many to hold.
  std::shared_ptr<const Eigen::MatrixXd> HarmonicBasis;

  /// Direction k of each face as a vector in space, #F x 3; counter-clockwise from direction 0.
  Points DirectionsOnFaces(const FramedMesh& surface, int k) const;
  /// Direction k of each vertex, likewise, #V x 3.
  Points DirectionsAtVertices(const FramedMesh& surface, int k) const;
};

/// Finds the directions of a field: all that can be drawn of it.
/// \param unknowns of the discretisation.
/// \param former of the same surface, whose first directions the new ones stay near to, if they are combed and of the same N;
///   or null.
/// \return without reports.
/// Checkpoints: three, up to half a second per million faces apart.
Field DirectionsOfField(const FramedMesh& surface, const Discretisation& discretisation, const Vector<double>& unknowns,
  bool combing, const Field* former, const ExecutionContext& context);

}

#endif
