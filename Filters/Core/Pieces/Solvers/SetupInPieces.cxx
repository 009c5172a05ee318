#include "Pieces/Solvers/SetupInPieces.h"

#include "Discretisations/MakeDiscretisation.h"
#include "Pieces/Constraints/ConstraintsInPieces.h"
#include "Pieces/Solvers/PieceLevels.h"
#include "Support/Stopwatch.h"

#include <algorithm>
#include <utility>

namespace dmg
{

namespace
{

/// Keeps consecutive rows, in place.
void KeepRows(SparseMatrix<Complex>& matrix, int first, int count)
{
  int* const offsets = matrix.outerIndexPtr();
  const int begin = offsets[first];
  const int end = offsets[first + count];
  std::copy(matrix.innerIndexPtr() + begin, matrix.innerIndexPtr() + end, matrix.innerIndexPtr());
  std::copy(matrix.valuePtr() + begin, matrix.valuePtr() + end, matrix.valuePtr());
  for (int row = 0; row <= count; ++row)
  {
    offsets[row] = offsets[first + row] - begin;
  }
  matrix.conservativeResize(count, matrix.cols());
  matrix.resizeNonZeros(end - begin);
}

}

SetupInPieces::SetupInPieces(
  const PieceOfSurface& piece, const DiscretisationOptions& options, const ExecutionContext& context)
  : Piece(piece)
{
  const Stopwatch watch;
  const Ranks& ranks = piece.Everyone();
  ranks.Together(
    [&]
    {
      const std::shared_ptr<const Discretisation> fields =
        MakeDiscretisation(options, piece.Surface(), &piece.Connection());
      this->Fields = { fields, fields->AtVertices() };
    });
  this->Components = ComponentsOfPieces(piece);
  const double meanArea = MeanAreaOfVertices(piece, *this->Fields);
  this->MeanArea = meanArea > 0.0 ? meanArea : 1.0;
  ranks.Together(
    [&]
    {
      const Vector<double> areas = this->Fields->AreasOfVertices(context);
      this->Mass = areas.segment(piece.FirstOwned(), piece.NumberOfOwned()) / this->MeanArea;
    });
  if (!(meanArea > 0.0))
  {
    this->Mass.setOnes();
  }
  std::vector<RowsOfRank<Complex>> prolongations = this->Prolongations(context);
  this->Multigrid = std::make_unique<PetscMultigrid>(
    ranks, this->OwnedRows(context), std::move(prolongations), this->Fields->Tuning().CyclesInARow);
  this->Seconds = watch.Seconds();
}

/// The equations of owned vertices, without penalties.
RowsOfRank<Complex> SetupInPieces::OwnedRows(const ExecutionContext& context) const
{
  RowsOfRank<Complex> stiffness;
  stiffness.OwnedColumns = this->Piece.NumberOfOwned();
  this->Piece.Everyone().Together(
    [&]
    {
      SparseMatrix<Complex> rows = this->Fields->Stiffness(context);
      stiffness.Rows.swap(rows);
      KeepRows(stiffness.Rows, this->Piece.FirstOwned(), this->Piece.NumberOfOwned());
      stiffness.GlobalColumns = this->Piece.GlobalNumbers();
    });
  return stiffness;
}

/// Prolongations of unknowns, from those of directions.
std::vector<RowsOfRank<Complex>> SetupInPieces::Prolongations(const ExecutionContext& context) const
{
  std::vector<RowsOfRank<Complex>> prolongations =
    LevelsOfPieces(this->Piece, VertexDiscretisation::DistanceOfSamples, PartOfContext(context, 0.2, 1.0));
  for (RowsOfRank<Complex>& prolongation : prolongations)
  {
    this->Piece.Everyone().Together(
      [&]
      {
        SparseMatrix<Complex> rows = this->Fields->ProlongationOfUnknowns(prolongation.Rows, context);
        prolongation.Rows.swap(rows);
      });
  }
  return prolongations;
}

}
