#include "Geodesics/ParallelTransport.h"

#include "Analysis/EdgeDistances.h"
#include "Geodesics/DiffusionOperators.h"
#include "Geodesics/IntrinsicTriangulation.h"
#include "Geodesics/ShortestPaths.h"
#include "Mesh/NormalParts.h"
#include "Mesh/VertexConnection.h"
#include "Operators/FunctionSource.h"
#include "Solvers/Direct/CholeskySolver.h"
#include "Support/Errors.h"
#include "Support/Remedy.h"
#include "Support/ShortText.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>

namespace dmg
{

namespace
{

constexpr double SmallestTimeStep = 0.01;
constexpr double LargestTimeStep = 1000.0;

/// The largest quotient of a component's diameter and the square root of the diffusion time. Heat falls by e for each such root, so it
/// stays within the range of doubles, e^-708, also where the diameter was found too small by half.
constexpr double LargestDecay = 300.0;

/// The heat below which numbers have lost digits: the smallest normal double is 2e-308.
constexpr double SmallestHeat = 1e-290;

/// Directions whose sum is shorter than this cancel each other.
constexpr double Cancelling = 1e-9;

constexpr int Grain = 4096;

/// The mean squared edge length of each component.
std::vector<double> MeanSquares(const TriangleMesh& mesh, const std::vector<int>& components, std::size_t size)
{
  std::vector<double> sums(size, 0.0);
  std::vector<int> edges(size, 0);
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const auto [tail, head] = mesh.EdgeVertices(edge);
    sums[components[tail]] += (mesh.Position(head) - mesh.Position(tail)).squaredNorm();
    ++edges[components[tail]];
  }
  for (std::size_t k = 0; k < size; ++k)
  {
    sums[k] /= std::max(edges[k], 1);
  }
  return sums;
}

Vector<double> TimesOf(const TriangleMesh& mesh, const std::vector<int>& components, double timeStep)
{
  const std::vector<double> diameters = ComponentDiameters(mesh, components);
  std::vector<double> times = MeanSquares(mesh, components, diameters.size());
  for (std::size_t k = 0; k < times.size(); ++k)
  {
    const double shortest = diameters[k] / LargestDecay;
    times[k] = std::max(timeStep * times[k], shortest * shortest);
  }
  Vector<double> ofVertices(mesh.NumberOfVertices());
  for (int vertex = 0; vertex < ofVertices.size(); ++vertex)
  {
    ofVertices[vertex] = times[components[vertex]];
  }
  return ofVertices;
}

/// \throw InvalidInput always: it names the point that is farthest from the others.
[[noreturn]] void RefuseThinTriangles(const TriangleMesh& mesh)
{
  Vector3 middle;
  for (int axis = 0; axis < 3; ++axis)
  {
    Vector<double> along = mesh.VertexPositions().col(axis);
    std::nth_element(along.begin(), along.begin() + along.size() / 2, along.end());
    middle[axis] = along[along.size() / 2];
  }
  int farthest = 0;
  for (int vertex = 1; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    farthest = (mesh.Position(vertex) - middle).stableNorm() > (mesh.Position(farthest) - middle).stableNorm()
      ? vertex
      : farthest;
  }
  const Vector3 place = mesh.Position(farthest);
  throw InvalidInput("triangles are too thin to carry vectors along them; the point at (" + ShortText(place[0]) + ", " +
    ShortText(place[1]) + ", " + ShortText(place[2]) +
    ") is the farthest from the others; move it, or remove its triangles");
}

/// The factor of a matrix of a mesh.
template <class Scalar>
std::unique_ptr<CholeskySolver<Scalar>> Factor(const SparseMatrix<Scalar>& matrix, const TriangleMesh& mesh)
{
  try
  {
    return std::make_unique<CholeskySolver<Scalar>>(matrix, FillOrdering::Best);
  }
  catch (const NotPositiveDefinite&)
  {
    RefuseThinTriangles(mesh);
  }
  catch (const FactorDoesNotFit&)
  {
    throw SolverFailure("the factors of parallel transport do not fit into memory; " + TextOf(Remedy::FewerTriangles));
  }
}

double LongestOf(const std::vector<ShortestPath>& paths)
{
  double longest = 0.0;
  for (const ShortestPath& path : paths)
  {
    longest = std::max(longest, path.IsAny() ? path.Length : 0.0);
  }
  return longest;
}

Complex UnitOf(Complex z)
{
  const double length = std::abs(z);
  return length > SmallestHeat ? z / length : Complex(0.0);
}

}

class ParallelTransport::Internals
{
public:
  Internals(const FramedMesh& surface, const TransportOptions& options, const ExecutionContext& context);

  void MakeFactors(const ExecutionContext& context);
  /// The vectors at the vertices that are sources, by vertex.
  std::map<int, Complex> VectorsOf(const Constraints& sources, std::vector<std::string>& warnings) const;
  Vector<Complex> VectorsOnFaces(const Vector<Complex>& atVertices, const ExecutionContext& context) const;
  /// The directions in which straight paths from a vertex to all others start, against a unit vector there; zero where no heat arrives.
  Vector<Complex> StraightDirections(int vertex, Complex unit, const ExecutionContext& context);

  const FramedMesh& Surface;
  const SidesOfSurface Sides;
  const std::vector<int> Components; ///< of vertices
  const VertexConnection Connection;
  const IntrinsicTriangulation Delaunay;
  const Vector<double> Times;
  const double TimeStep;
  std::unique_ptr<CholeskySolver<double>> OfFunctions;
  std::unique_ptr<CholeskySolver<Complex>> OfVectors;
  StageCounts Counts;
};

namespace
{

double Checked(double timeStep)
{
  if (!(timeStep >= SmallestTimeStep && timeStep <= LargestTimeStep))
  {
    throw InvalidInput("the time step is " + ShortText(timeStep) + "; give one from " + ShortText(SmallestTimeStep) +
      " to " + ShortText(LargestTimeStep));
  }
  return timeStep;
}

}

ParallelTransport::Internals::Internals(
  const FramedMesh& surface, const TransportOptions& options, const ExecutionContext& context)
  : Surface(surface)
  , Sides(FindSides(surface.Mesh))
  , Components(VertexComponents(surface.Mesh))
  , Connection(surface, context)
  , Delaunay(surface, this->Connection, context)
  , Times(TimesOf(surface.Mesh, this->Components, Checked(options.TimeStep)))
  , TimeStep(options.TimeStep)
{
}

void ParallelTransport::Internals::MakeFactors(const ExecutionContext& context)
{
  if (this->OfVectors)
  {
    return;
  }
  context.Checkpoint(0.0);
  this->OfFunctions = Factor(DiffusionOfFunctions(this->Delaunay, this->Times), this->Surface.Mesh);
  context.Checkpoint(0.4);
  this->OfVectors = Factor(DiffusionOfVectors(this->Delaunay, this->Times), this->Surface.Mesh);
  context.Checkpoint(1.0);
  ++this->Counts.Setups;
}

std::map<int, Complex> ParallelTransport::Internals::VectorsOf(
  const Constraints& sources, std::vector<std::string>& warnings) const
{
  struct Sums
  {
    Complex Directions;
    double Lengths = 0.0, Shares = 0.0;
  };
  const TriangleMesh& mesh = this->Surface.Mesh;
  std::map<int, Sums> sums;
  const auto add = [&sums](int vertex, Complex direction, double length, double share)
  {
    Sums& at = sums[vertex];
    at.Directions += share * direction;
    at.Lengths += share * length;
    at.Shares += share;
  };
  const ElementNames names;
  for (const Constraint& at : sources.AtVertices)
  {
    CheckElement(at.Element, mesh.NumberOfVertices(), "vertex");
    const Vector3 direction = WithoutNormalPart(mesh, this->Surface.Vertices, at.Element, at.Direction);
    const Complex vector =
      TangentialPart(this->Surface.Vertices, at.Element, direction, at.Weight, names.Vertex(at.Element), "vertex");
    add(at.Element, vector / std::abs(vector), std::abs(vector), at.Weight);
  }
  for (const Constraint& on : sources.OnFaces)
  {
    CheckElement(on.Element, mesh.NumberOfFaces(), "face");
    const Complex vector =
      TangentialPart(this->Surface.Faces, on.Element, on.Direction, on.Weight, names.Face(on.Element), "face");
    const Complex direction = vector / std::abs(vector);
    for (int h = 3 * on.Element; h < 3 * on.Element + 3; ++h)
    {
      add(mesh.Tail(h), this->Connection.TurnFromFace(h) * direction, std::abs(vector), on.Weight / 3.0);
    }
  }
  std::map<int, Complex> vectors;
  int cancelled = 0;
  for (const auto& [vertex, sum] : sums)
  {
    const bool isAny = std::abs(sum.Directions) > Cancelling * sum.Shares;
    if (sum.Shares > 0.0)
    {
      vectors[vertex] = isAny ? sum.Lengths / sum.Shares * UnitOf(sum.Directions) : Complex(0.0);
      cancelled += isAny ? 0 : 1;
    }
  }
  if (cancelled > 0)
  {
    warnings.push_back("The vectors given at " + std::to_string(cancelled) + " of " + std::to_string(vectors.size()) +
      " points cancel each other; what is carried from there is zero.");
  }
  return vectors;
}

Vector<Complex> ParallelTransport::Internals::VectorsOnFaces(
  const Vector<Complex>& atVertices, const ExecutionContext& context) const
{
  const TriangleMesh& mesh = this->Surface.Mesh;
  Vector<Complex> vectors(mesh.NumberOfFaces());
  context.ParallelFor(0, mesh.NumberOfFaces(), Grain,
    [&](int first, int last)
    {
      for (int face = first; face < last; ++face)
      {
        // The direction of the mean, and the mean of the lengths: where directions spread, as around a pole, lengths stay.
        Complex sum = 0.0;
        double lengths = 0.0;
        for (int h = 3 * face; h < 3 * face + 3; ++h)
        {
          const Complex vector = atVertices[mesh.Tail(h)];
          sum += std::conj(this->Connection.TurnFromFace(h)) * vector;
          lengths += std::abs(vector) / 3.0;
        }
        vectors[face] = lengths * UnitOf(sum);
      }
    });
  return vectors;
}

Vector<Complex> ParallelTransport::Internals::StraightDirections(
  int vertex, Complex unit, const ExecutionContext& context)
{
  this->MakeFactors(context);
  const int size = static_cast<int>(this->Times.size());
  Vector<double> one = Vector<double>::Zero(size);
  one[vertex] = 1.0;
  Vector<Complex> first = Vector<Complex>::Zero(size);
  first[vertex] = unit;
  Vector<double> heat;
  Vector<Complex> reference, positions;
  this->OfFunctions->Solve(one, heat);
  this->OfVectors->Solve(first, reference);
  this->OfVectors->Solve(SourceOfPositions(this->Delaunay, heat), positions);
  for (int other = 0; other < size; ++other)
  {
    positions[other] = heat[other] > SmallestHeat ? positions[other] / heat[other] : Complex(0.0);
    positions[other] = -UnitOf(positions[other]) * std::conj(UnitOf(reference[other]));
  }
  return positions;
}

ParallelTransport::ParallelTransport(
  const FramedMesh& surface, const TransportOptions& options, const ExecutionContext& context)
  : Internal(std::make_unique<Internals>(surface, options, context))
{
}

ParallelTransport::~ParallelTransport() = default;

ParallelTransport::ParallelTransport(ParallelTransport&&) noexcept = default;

TransportedField ParallelTransport::Carry(const Constraints& sources, const ExecutionContext& context)
{
  Internals& of = *this->Internal;
  if (sources.AtVertices.empty() && sources.OnFaces.empty())
  {
    throw InvalidInput("there is no direction to carry; give one at least, at a vertex or on a face");
  }
  CheckSizes(sources);
  std::vector<PathStart> starts;
  std::vector<Complex> vectors;
  TransportedField field;
  for (const auto& [vertex, vector] : of.VectorsOf(sources, field.Warnings))
  {
    starts.push_back({ vertex, static_cast<int>(vectors.size()) });
    vectors.push_back(vector);
  }
  constexpr double Anywhere = std::numeric_limits<double>::infinity();
  const std::vector<ShortestPath> paths =
    FindShortestPaths(of.Delaunay, starts, Anywhere, PartOfContext(context, 0.0, 0.9));
  ++of.Counts.Solves;
  field.AtVertices.setZero(static_cast<Eigen::Index>(paths.size()));
  for (std::size_t vertex = 0; vertex < paths.size(); ++vertex)
  {
    const ShortestPath& path = paths[vertex];
    field.WithoutSource += path.IsAny() ? 0 : 1;
    field.AtVertices[static_cast<Eigen::Index>(vertex)] =
      path.IsAny() ? vectors[path.Source] * std::polar(1.0, path.Turn) : Complex(0.0);
  }
  field.OnFaces = of.VectorsOnFaces(field.AtVertices, context);
  context.Checkpoint(1.0);
  return field;
}

LogarithmicMap ParallelTransport::Map(int vertex, Complex direction, const ExecutionContext& context)
{
  Internals& of = *this->Internal;
  const int size = of.Surface.Mesh.NumberOfVertices();
  CheckElement(vertex, size, "vertex");
  const double length = std::abs(direction);
  if (!(length > 0.0) || !std::isfinite(length))
  {
    throw InvalidInput("the direction of the angle 0 is zero or not finite; give one in the tangent plane");
  }
  const Vector<Complex> straight = of.StraightDirections(vertex, direction / length, PartOfContext(context, 0.0, 0.7));
  constexpr double Anywhere = std::numeric_limits<double>::infinity();
  const std::vector<ShortestPath> paths =
    FindShortestPaths(of.Delaunay, { { vertex } }, Anywhere, PartOfContext(context, 0.7, 1.0));
  constexpr double Nothing = std::numeric_limits<double>::quiet_NaN();
  LogarithmicMap map{ Vector<Complex>::Constant(size, Complex(Nothing, Nothing)),
    Vector<double>::Constant(size, Nothing), Vector<double>::Constant(size, Nothing), {} };
  const TriangleMesh& mesh = of.Surface.Mesh;
  // Directions of heat are those of straight paths. Where those of the wavefront differ by more than its error, paths bend around a hole.
  constexpr double LargestError = 4.0; // of a wavefront, in edges
  const double edge = std::sqrt(of.Times[vertex] / of.TimeStep);
  const double largestDifference = LargestError * edge / LongestOf(paths);
  for (int other = 0; other < size; ++other)
  {
    if (!paths[other].IsAny())
    {
      ++map.Unreached;
      continue;
    }
    // The wavefront may be short where paths from both sides of a sharp rim meet; no path is shorter than the way through space.
    const double throughSpace = (mesh.Position(other) - mesh.Position(vertex)).norm();
    map.Distances[other] = std::max(paths[other].Length, throughSpace);
    const double turned = std::remainder(paths[other].Outset - std::arg(direction), 2.0 * Pi);
    const double difference = std::abs(std::remainder(turned - std::arg(straight[other]), 2.0 * Pi));
    const bool isStraight = straight[other] != 0.0 && difference <= largestDifference;
    map.Angles[other] =
      other == vertex ? 0.0 : of.Sides.OfVertices[vertex] * (isStraight ? std::arg(straight[other]) : turned);
    map.Coordinates[other] = std::polar(map.Distances[other], map.Angles[other]);
  }
  ++of.Counts.Solves;
  context.Checkpoint(1.0);
  return map;
}

const SidesOfSurface& ParallelTransport::Sides() const
{
  return this->Internal->Sides;
}

const Vector<double>& ParallelTransport::Times() const
{
  return this->Internal->Times;
}

long long ParallelTransport::Bytes() const
{
  const Internals& of = *this->Internal;
  return (of.OfFunctions ? of.OfFunctions->Bytes() : 0) + (of.OfVectors ? of.OfVectors->Bytes() : 0);
}

ParallelTransport::StageCounts ParallelTransport::Counts() const
{
  return this->Internal->Counts;
}

}
