#include "Partitions.h"
#include "Pieces/ScaleFilterInPieces.h"
#include "Scales/Spectrum.h"
#include "Support/ComplexPairs.h"
#include "Support/Errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

using namespace dmg;

namespace
{

const double Tolerance = 1e-8;

/// Large and small waves.
double HeightAt(const Vector3& p)
{
  return 2.0 + p[2] + 0.5 * std::sin(4.0 * p[0] + p[1]) + 0.25 * std::cos(23.0 * p[1] - 9.0 * p[2]);
}

Vector3 WindAt(const Vector3& p)
{
  return Vector3(-p[1], p[0], 0.5) + std::sin(15.0 * p[2] + 2.0 * p[0]) * Vector3(0.2, 0.0, 0.4);
}

Vector<double> QuantityOn(const FramedMesh& surface, ScaledQuantity quantity)
{
  const int vertices = surface.Mesh.NumberOfVertices();
  Vector<double> numbers(quantity == ScaledQuantity::Vectors ? 2 * vertices : vertices);
  for (int vertex = 0; vertex < vertices; ++vertex)
  {
    const Vector3 place = surface.Mesh.Position(vertex);
    if (quantity == ScaledQuantity::Function)
    {
      numbers[vertex] = HeightAt(place);
      continue;
    }
    const Complex wind = surface.Vertices.ToComplex(vertex, WindAt(place));
    numbers[2 * vertex] = wind.real();
    numbers[2 * vertex + 1] = wind.imag();
  }
  return numbers;
}

/// A quantity at a vertex as a vector in space; a function along the first axis.
Vector3 At(const FramedMesh& surface, const Vector<double>& quantity, int vertex)
{
  return quantity.size() == surface.Mesh.NumberOfVertices()
    ? Vector3(quantity[vertex], 0.0, 0.0)
    : surface.Vertices.ToVector(vertex, Complex(quantity[2 * vertex], quantity[2 * vertex + 1]));
}

ScaleFilterOptions OptionsOf(ScaledQuantity quantity, int order)
{
  ScaleFilterOptions options;
  options.Quantity = quantity;
  options.Order = order;
  return options;
}

/// The same surface on one process and in pieces.
struct BothWays
{
  BothWays(const test::Surface& surface, const test::NamedPartition& partition)
    : All(MPI_COMM_WORLD)
    , Whole(surface.Mesh())
    , Cut(test::CutOut(surface, partition.RanksOfTriangles(surface, this->All.Size()), this->All.Rank()))
    , Piece(this->All, this->Cut.Piece, {}, SerialContext())
  {
  }

  /// The largest difference at the points of all pieces, over the largest number.
  double Difference(const Vector<double>& here, const Vector<double>& whole) const
  {
    double largest = 0.0;
    for (std::size_t i = 0; i < this->Cut.Points.size(); ++i)
    {
      const int vertex = this->Piece.VerticesOfPoints()[i];
      const Vector3 difference = At(this->Piece.Surface(), here, vertex) - At(this->Whole, whole, this->Cut.Points[i]);
      largest = std::max(largest, difference.norm());
    }
    return this->All.Max(largest) / whole.cwiseAbs().maxCoeff();
  }

  const Ranks All;
  const FramedMesh Whole;
  const test::CutPiece Cut;
  const PieceOfSurface Piece;
};

/// Compares the parts of a quantity at wavelengths of 1 to 1,000 edges.
void CheckParts(const test::Surface& surface, ScaledQuantity quantity, int order)
{
  ScaleFilterOptions options = OptionsOf(quantity, order);
  options.Solver.Kind = SolverKind::Cholesky;
  const FramedMesh whole(surface.Mesh());
  const Vector<double> given = QuantityOn(whole, quantity);
  ScaleFilter onOne(whole, options);
  std::vector<std::unique_ptr<const BothWays>> pieces;
  std::vector<ScaleFilter> filters;
  std::vector<test::NamedPartition> partitions = test::Partitions();
  partitions.resize(
    Ranks(MPI_COMM_WORLD).Size() == 1 ? 1 : partitions.size()); // one rank has all, whatever the partition
  for (const test::NamedPartition& partition : partitions)
  {
    pieces.push_back(std::make_unique<const BothWays>(surface, partition));
    filters.push_back(ScaleFilterInPieces(pieces.back()->Piece, OptionsOf(quantity, order)));
  }
  for (const double wavelength : { 0.1, 1.4, 50.0 })
  {
    const StoppingCriteria stop{ Tolerance, 100 };
    const SplitScales expected = onOne.Split(given, wavelength, stop);
    for (std::size_t k = 0; k < pieces.size(); ++k)
    {
      SCOPED_TRACE(partitions[k].Name + ", order " + std::to_string(order) + ", " + std::to_string(wavelength));
      const SplitScales here = filters[k].Split(QuantityOn(pieces[k]->Piece.Surface(), quantity), wavelength, stop);
      EXPECT_TRUE(filters[k].Report().Converged);
      EXPECT_LE(filters[k].Report().Returned, 25);
      EXPECT_EQ(filters[k].Report().Warnings, onOne.Report().Warnings);
      EXPECT_LE(pieces[k]->Difference(here.Below, expected.Below), 100 * Tolerance);
      EXPECT_LE(pieces[k]->Difference(here.Above, expected.Above), 100 * Tolerance);
      EXPECT_NEAR(filters[k].Energy(here.Above), onOne.Energy(expected.Above), 1e-6 * onOne.Energy(given));
    }
  }
}

}

TEST(ScaleFilterInPieces, HasTheFunctionsOfOneProcess)
{
  CheckParts(test::IrregularSphere(4, 3), ScaledQuantity::Function, 1);
  CheckParts(test::IrregularSphere(4, 3), ScaledQuantity::Function, 2);
}

TEST(ScaleFilterInPieces, HasTheVectorsOfOneProcess)
{
  CheckParts(test::IrregularSphere(4, 3), ScaledQuantity::Vectors, 1);
  CheckParts(test::IrregularSphere(4, 3), ScaledQuantity::Vectors, 2);
}

TEST(ScaleFilterInPieces, MeansStay)
{
  const BothWays both(test::IrregularPlane(40, 30, 5), test::Partitions()[1]);
  ScaleFilter filter = ScaleFilterInPieces(both.Piece);
  const Vector<double> height = QuantityOn(both.Piece.Surface(), ScaledQuantity::Function);
  const double mean = filter.Mean(height);
  EXPECT_NEAR(mean, ScaleFilter(both.Whole).Mean(QuantityOn(both.Whole, ScaledQuantity::Function)), 1e-12 * mean);
  EXPECT_NEAR(filter.Mean(filter.Split(height, 0.5).Below), mean, 1e-12 * mean);
  const auto constant = [](Eigen::Index size) { return Vector<double>::Constant(size, 35.0).eval(); };
  const Vector<double> below = filter.Split(constant(height.size()), 0.5).Below;
  EXPECT_LE(both.Difference(below, constant(both.Whole.Mesh.NumberOfVertices())), 1e-12);
}

TEST(ScaleFilterInPieces, SpectraAreThoseOfOneProcess)
{
  const BothWays both(test::IrregularSphere(4, 3), test::Partitions()[1]);
  ScaleFilter inPieces = ScaleFilterInPieces(both.Piece);
  ScaleFilter onOne(both.Whole);
  const Vector<double> bounds = SpectrumBounds(0.2, 8.0, 5);
  const Spectrum here =
    FindSpectra(inPieces, { QuantityOn(both.Piece.Surface(), ScaledQuantity::Function) }, bounds).front();
  const Spectrum expected = FindSpectra(onOne, { QuantityOn(both.Whole, ScaledQuantity::Function) }, bounds).front();
  EXPECT_NEAR(here.Total, expected.Total, 1e-12 * expected.Total);
  EXPECT_NEAR(here.Energies.sum(), here.Total, 1e-12 * here.Total);
  EXPECT_LE((here.Energies - expected.Energies).cwiseAbs().maxCoeff(), 1e-5 * expected.Total);
}

TEST(ScaleFilterInPieces, RefusesOnAllRanksWhatOneProcessDoes)
{
  const BothWays both(test::Icosphere(2), test::Partitions()[0]);
  ScaleFilterOptions options;
  options.Fixed = { 0 };
  EXPECT_THROW(ScaleFilterInPieces(both.Piece, options), InvalidInput);
  options = {};
  options.RelativeWavelengths.assign(both.Piece.NumberOfVertices(), 1.0);
  EXPECT_THROW(ScaleFilterInPieces(both.Piece, options), InvalidInput);
  options = {};
  options.Solver.Kind = SolverKind::Cholesky;
  EXPECT_THROW(ScaleFilterInPieces(both.Piece, options), InvalidInput);
  if (both.All.Size() > 1)
  {
    options = {};
    options.Order = both.All.Rank() == 0 ? 1 : 2;
    EXPECT_THROW(ScaleFilterInPieces(both.Piece, options), InvalidInput);
  }
  ScaleFilter filter = ScaleFilterInPieces(both.Piece);
  Vector<double> height = QuantityOn(both.Piece.Surface(), ScaledQuantity::Function);
  height[0] = both.All.Rank() == 0 ? std::nan("") : 1.0;
  EXPECT_THROW(filter.Split(height, 1.0), InvalidInput);
}
