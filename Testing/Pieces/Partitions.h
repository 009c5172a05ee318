#ifndef dmgTestPartitions_h
#define dmgTestPartitions_h

#include "Constraints/Constraints.h"
#include "Pieces/Surface/PieceOfSurface.h"
#include "Pieces/Surface/SeamSides.h"
#include "Support/MeshFactory.h"

#include <functional>
#include <string>
#include <vector>

/// Surfaces cut into pieces in every way that files and simulations do.
namespace dmg::test
{

/// A piece of a surface, and where its elements were.
struct CutPiece
{
  SurfacePiece Piece;
  std::vector<int> Triangles; ///< of the whole surface, per triangle of the piece
  std::vector<int> Points;    ///< of the whole surface, per point of the piece
};

/// \param rankOfTriangles says who has each triangle.
CutPiece CutOut(const Surface& surface, const std::vector<int>& rankOfTriangles, int rank);

struct NamedPartition
{
  std::string Name;
  std::function<std::vector<int>(const Surface&, int numberOfRanks)> RanksOfTriangles;
};

/// Blocks in the order of the file; random tiles; one triangle on the last rank; none on the first rank.
std::vector<NamedPartition> Partitions();

/// The piece of this rank in the first partition.
CutPiece PieceHere(const Surface& surface, MPI_Comm communicator = MPI_COMM_WORLD);

/// On one triangle of each rank that has so many, along its first side.
Constraints OneDirection(const PieceOfSurface& piece, int triangle = 0);

}

#endif
