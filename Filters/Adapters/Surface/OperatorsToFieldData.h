#ifndef dmgOperatorsToFieldData_h
#define dmgOperatorsToFieldData_h

#include "Levels/ProlongationOperators.h"
#include "Mesh/SurfaceRelation.h"
#include "Mesh/TriangleMesh.h"
#include "StructurePreserving/Decimation/HierarchyOptions.h"

#include <optional>
#include <string>

class vtkFieldData;

namespace dmg
{

/// The identity of stored operators: equal origins, equal operators.
struct OperatorsOrigin
{
  std::string Digest; ///< of the surface, ContentDigest()
  HierarchyOptions Options;
  OperatorSelection Selection;

  bool operator==(const OperatorsOrigin& other) const;
};

/// Writes the operators and their origin as field data, in the form that
/// vtkDirectionalProlongation.h lists. Arrays of equal names are replaced. \pre the matrices are
/// compressed.
void OperatorsToFieldData(
  const ProlongationOperators& operators, const OperatorsOrigin& origin, vtkFieldData* fieldData);

/// Writes the cell of each triangle and the point of each vertex that the operators refer to, as Prolongation.CellsOfFaces
/// and Prolongation.PointsOfVertices, where these are not simply the triangles and points of the surface.
void RelationToFieldData(const SurfaceRelation& relation, const TriangleMesh& mesh, vtkFieldData* fieldData);

/// Removes whatever operators \p fieldData holds.
void RemoveOperators(vtkFieldData* fieldData);

/// The origin of the operators in \p fieldData, which may be null; nothing where it holds none.
/// \throw InvalidInput there are operators without a readable origin or of a newer format.
std::optional<OperatorsOrigin> OperatorsOriginOf(vtkFieldData* fieldData);

/// Reads the operators back. Nothing is trusted: kinds and lengths of arrays, offsets that never
/// decrease, columns ascending and in range, finite values, weights that sum to 1 in every row.
/// \param mesh the surface that they shall fit.
/// \throw InvalidInput the array that is missing or damaged, and how.
/// Cost: linear.
ProlongationOperators OperatorsFromFieldData(vtkFieldData* fieldData, const TriangleMesh& mesh);

}

#endif
