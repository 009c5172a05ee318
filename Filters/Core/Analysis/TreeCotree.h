#ifndef dmgTreeCotree_h
#define dmgTreeCotree_h

#include "Mesh/TriangleMesh.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// The element that the boundary of a component is contracted to.
enum class BoundaryAs
{
  Face,   ///< what lies beyond it is one more face, the root of the faces' tree
  Vertex, ///< all of its vertices are one, the root of the vertices' tree
};

/// A spanning tree of the vertices and one of the faces, which does not cross the edges of the former (Eppstein 2003);
/// both of each component.
struct TreeCotree
{
  std::vector<int> Faces; ///< parents before children
  /// By face, the side towards the parent; -1 at roots. It has no twin where the parent is what lies beyond the boundary.
  std::vector<int> ParentHalfedges;
  /// Edges in neither tree, ascending: one per independent loop, 2 g + b - 1 of each component (2 g where b is zero).
  std::vector<int> Generators;
};

/// Cost: O(#E).
TreeCotree MakeTreeCotree(const TriangleMesh& mesh, BoundaryAs boundary);

/// Loops over faces, one per generator, #E x (2 g + b - 1): it crosses the generator and returns over the faces' tree. An
/// entry is 1 where the loop crosses an edge from the face of HalfedgeOf to that of its twin, else -1. As 1-forms these are
/// closed, vanish on the boundary, and span the classes of such forms.
/// \pre trees are those of BoundaryAs::Vertex
/// Cost: O(#F), and the length of the loops.
SparseMatrix<double> GeneratorsOverFaces(const TriangleMesh& mesh, const TreeCotree& trees);

}

#endif
