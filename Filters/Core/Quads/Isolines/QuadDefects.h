#ifndef dmgQuadDefects_h
#define dmgQuadDefects_h

#include "Mesh/TriangleMesh.h"
#include "Quads/Isolines/IndexedQuads.h"
#include "Quads/Isolines/IsolineArrangement.h"
#include "Quads/Isolines/IsolineCells.h"

#include <vector>

namespace dmg
{

/// The places where quads are not a mesh of the surface: a component has another Euler number, or is lost; a hole has fewer than three
/// edges around it; an edge has two quads on one side; a quad has a vertex twice; the quads around a vertex are no fan; an inner vertex
/// has fewer than three of them. All of these mean that the quads are too large for what the surface has there.
struct QuadDefects
{
  int Number = 0;                     ///< of defects, 0 where the mesh is good
  int CutOff = 0;                     ///< number of isolines beyond which a thin part at the boundary may be lost
  std::vector<char> AreBad;           ///< by face of the surface: whether edges should be shorter there
  std::vector<char> AreComponentsBad; ///< by component of the surface: whether it has a defect
  int LostComponent = -1;             ///< a face of a component without quads
  int SmallHole = -1;                 ///< a vertex on a hole with too few edges
  int Handle = -1;                    ///< a vertex where a cell is no disc, or quads do not fit
};

/// \param components of the faces of the surface (FaceComponents).
/// \param before quads before they were cleaned up.
/// \param isBoundaryAligned whether an isoline that goes from the boundary to the boundary and crosses no other one should not be: a part
///   beyond it may be lost. Elsewhere such isolines cut off corners.
QuadDefects FindDefects(const TriangleMesh& mesh, const std::vector<int>& components,
  const IsolineArrangement& isolines, const IsolineCells& cells, const IndexedQuads& before, const IndexedQuads& quads,
  const QuadTopology& topology, bool isBoundaryAligned);

/// The number of vertices less edges plus quads, by component.
/// \param components of the faces of the surface.
std::vector<int> EulerNumbers(
  const std::vector<int>& components, int numberOfComponents, const IndexedQuads& quads, const QuadTopology& topology);
/// The number of vertices less edges plus faces of the surface, by component.
std::vector<int> EulerNumbers(const TriangleMesh& mesh, const std::vector<int>& components, int numberOfComponents);

}

#endif
