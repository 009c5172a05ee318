#include "Pieces/SourceInPieces.h"

#include "Operators/FunctionSource.h"
#include "Support/Errors.h"
#include "Support/ShortText.h"

#include <cmath>
#include <string>

namespace dmg
{

namespace
{

void CheckSource(const PieceOfSurface& piece, const Vector<double>& source, const ElementNames& names)
{
  const int points = static_cast<int>(piece.VerticesOfPoints().size());
  if (source.size() != points)
  {
    throw InvalidInput("the source has " + std::to_string(source.size()) + " numbers in place of one for each of the " +
      std::to_string(points) + " points of a piece");
  }
  for (int point = 0; point < points; ++point)
  {
    if (!(std::abs(source[point]) <= LargestPrescribed))
    {
      throw InvalidInput("the source is " + ShortText(source[point]) + " at " + names.Vertex(point) +
        ", which is not finite or too large; repair it");
    }
  }
}

/// Of several points at a vertex the first counts.
std::vector<double> AtOwned(const PieceOfSurface& piece, const Vector<double>& source)
{
  std::vector<double> owned(piece.NumberOfOwned(), 0.0);
  for (Eigen::Index point = source.size() - 1; point >= 0; --point)
  {
    if (const int vertex = piece.VerticesOfPoints()[point]; vertex >= 0 && piece.IsOwned(vertex))
    {
      owned[vertex - piece.FirstOwned()] = source[point];
    }
  }
  return owned;
}

}

SourceInPieces::SourceInPieces(const PieceOfSurface& piece, const PieceComponents& components,
  const Constraints& constraints, const ElementNames& names)
  : Piece(piece)
  , Components(components)
  , IsGiven(piece.Everyone().Any(constraints.Source.size() > 0))
  , Integrals(Vector<double>::Zero(piece.NumberOfOwned()))
  , Areas(this->Integrals)
{
  if (!this->IsGiven)
  {
    return;
  }
  piece.Everyone().Together([&] { CheckSource(piece, constraints.Source, names); });
  const std::vector<double> all = piece.WithGhosts<double>(AtOwned(piece, constraints.Source));
  piece.Everyone().Together(
    [&]
    {
      if (!piece.IsEmpty())
      {
        const Eigen::Map<const Vector<double>> f(all.data(), static_cast<Eigen::Index>(all.size()));
        const TriangleMesh& mesh = piece.Surface().Mesh;
        this->Integrals = IntegratedSource(mesh, f).segment(piece.FirstOwned(), piece.NumberOfOwned());
        this->Areas = IntegratedSource(mesh).segment(piece.FirstOwned(), piece.NumberOfOwned());
      }
    });
}

Vector<double> SourceInPieces::SumsOfComponents(const Vector<double>& owned) const
{
  Vector<double> sums = Vector<double>::Zero(this->Components.NumberBound);
  for (Eigen::Index i = 0; i < owned.size(); ++i)
  {
    sums[this->Components.OfOwned[i]] += owned[i];
  }
  this->Piece.Everyone().Sum(sums.data(), static_cast<int>(sums.size()));
  return sums;
}

void SourceInPieces::Balance(const std::vector<char>& isReached, NetSource net)
{
  const Vector<double> sums = this->SumsOfComponents(this->Integrals);
  const Vector<double> magnitudes = this->SumsOfComponents(this->Integrals.cwiseAbs());
  const Vector<double> areas = this->SumsOfComponents(this->Areas);
  for (std::size_t component = 0; component < isReached.size() && net == NetSource::Refuse; ++component)
  {
    if (!isReached[component])
    {
      CheckNetSource(sums[component], magnitudes[component], "a component of the surface");
    }
  }
  for (Eigen::Index i = 0; i < this->Integrals.size(); ++i)
  {
    const int component = this->Components.OfOwned[i];
    if (!isReached[component] && net == NetSource::TakeOut)
    {
      this->Integrals[i] -= this->Areas[i] * (sums[component] / areas[component]);
    }
  }
}

void SourceInPieces::Centre(const std::vector<char>& isReached, Vector<Complex>& owned) const
{
  const Vector<double> sums = this->SumsOfComponents(this->Areas.cwiseProduct(owned.real()));
  const Vector<double> areas = this->SumsOfComponents(this->Areas);
  for (Eigen::Index i = 0; i < owned.size(); ++i)
  {
    const int component = this->Components.OfOwned[i];
    owned[i] -= isReached[component] ? 0.0 : sums[component] / areas[component];
  }
}

}
