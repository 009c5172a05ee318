#ifndef dmgCutSurface_h
#define dmgCutSurface_h

#include "Mesh/TriangleMesh.h"
#include "Quads/Crosses/CrossField.h"

#include <vector>

namespace dmg
{

/// A surface cut into discs, in each of which the directions of a cross field go on as those of the same number.
///
/// The cut runs along edges, through all singularities. A *seam* is a line of cut edges between two of its nodes; nodes are ends,
/// branches, singularities, and places on the boundary. The matching is the same all along a seam.
struct CutSurface
{
  std::vector<signed char>
    Matchings;                 ///< PrincipalMatching::Offsets of the combed field; 0 across edges that are not cut
  std::vector<char> IsCut;     ///< by edge; edges of the boundary are not
  std::vector<int> Seams;      ///< by halfedge: the number of its seam, -1 where it is not cut
  std::vector<char> IsForward; ///< by halfedge: whether it runs along its seam
  int NumberOfSeams = 0;
};

/// Renumbers the directions of all faces so that they go on along a tree over the faces (combing), and cuts the surface where they do
/// not, or where it would not be a disc otherwise.
/// \param field its angles and matchings change by quarter turns.
/// Cost: O(#F).
CutSurface CutAlongSeams(const TriangleMesh& mesh, CrossField& field);

}

#endif
