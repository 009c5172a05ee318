#ifndef dmgIndexedQuads_h
#define dmgIndexedQuads_h

#include "Quads/Isolines/IsolineArrangement.h"
#include "Quads/Isolines/IsolineCells.h"

#include <array>
#include <vector>

namespace dmg
{

/// Quads as vertices in counter-clockwise order, before they are known to be a good mesh.
struct IndexedQuads
{
  std::vector<std::array<int, 4>> Corners; ///< by quad
  std::vector<int> Faces;                  ///< by quad: the face of the surface in which its isolines cross
  std::vector<char> IsOnBoundary;          ///< by vertex

  int Size() const { return static_cast<int>(this->Corners.size()); }
  int NumberOfVertices() const { return static_cast<int>(this->IsOnBoundary.size()); }
};

/// The quads around the crossings; their vertices are the cells.
IndexedQuads QuadsOfCells(const IsolineArrangement& isolines, const IsolineCells& cells);

/// The sides at which quads meet. Side 4 q + k goes from corner k of quad q to the next one.
struct QuadTopology
{
  explicit QuadTopology(const IndexedQuads& quads);

  std::vector<int> Twins;       ///< by side: the side that runs the other way, -1 where there is none
  std::vector<int> Repeated;    ///< sides that run as another one, from the same vertex to the same vertex
  std::vector<int> Valences;    ///< by vertex: the number of its quads
  std::vector<int> Fans;        ///< by vertex: the number of sets of quads around it, joined by sides
  std::vector<int> TwiceInQuad; ///< quads that have a vertex twice
  int NumberOfEdges = 0;

private:
  void PairSides(const IndexedQuads& quads);
};

/// Removes what folds of the map leave behind, and keeps the Euler number: doublets, two quads that share two sides, become one quad;
/// quads with the same vertex at two opposite corners are closed like a book.
/// \param ranks by vertex: of two that become one, that of the higher rank stays.
void CleanUp(IndexedQuads& quads, const std::vector<int>& ranks);

/// Keeps of each component of the surface the most quads that are joined by sides, and of those around a vertex one fan. Where the boundary
/// is not aligned, some quads near its corners hang on the others by a vertex alone.
/// \param components of the faces of the surface (FaceComponents).
void DropLooseQuads(const std::vector<int>& components, IndexedQuads& quads);

}

#endif
