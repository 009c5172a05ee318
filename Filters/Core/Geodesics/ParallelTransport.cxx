#include "Geodesics/ParallelTransport.h"

#include "Geodesics/DiffusionOperators.h"
#include "Geodesics/EdgeDistances.h"
#include "Geodesics/IntrinsicTriangulation.h"
#include "Mesh/VertexConnection.h"
#include "Operators/FunctionSource.h"
#include "Solvers/Direct/CholeskySolver.h"
#include "Support/Errors.h"
#include "Support/Remedy.h"
#include "Support/ShortText.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

/// The part of all points whose distances may need a large correction before a warning says so.
constexpr double MostCorrected = 0.01;

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

/// Distances are at least those through space and at most those along edges. On uneven triangles, integrated ones may not be.
/// \return of how many the correction was large, more than 2 % of the largest distance.
int KeepWithinBounds(const TriangleMesh& mesh, int from, Vector<double>& distances)
{
  constexpr double Large = 0.02;
  const Vector<double> alongEdges = DistancesAlongEdges(mesh, { from });
  double largest = 0.0;
  for (const double distance : alongEdges)
  {
    largest = std::isfinite(distance) ? std::max(largest, distance) : largest;
  }
  int large = 0;
  for (int vertex = 0; vertex < distances.size(); ++vertex)
  {
    if (!std::isfinite(alongEdges[vertex]))
    {
      continue; // on another component
    }
    const double straight = (mesh.Position(vertex) - mesh.Position(from)).norm();
    const double kept = std::min(std::max(distances[vertex], straight), alongEdges[vertex]);
    large += std::abs(kept - distances[vertex]) > Large * largest ? 1 : 0;
    distances[vertex] = kept;
  }
  return large;
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
  catch (const UnexpectedFailure&)
  {
    throw;
  }
  catch (const SolverFailure&)
  {
    throw SolverFailure("the factors of parallel transport do not fit into memory; " + TextOf(Remedy::FewerTriangles));
  }
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
  /// The sources of directions, of lengths and of ones.
  struct Heat
  {
    Vector<Complex> Directions;
    CholeskySolver<double>::Columns LengthsAndOnes;
  };
  Heat HeatOf(const Constraints& sources) const;
  Vector<Complex> VectorsOnFaces(const Vector<Complex>& atVertices, const ExecutionContext& context) const;
  std::vector<std::string> WarningsOf(const std::vector<char>& hasSource, const Vector<double>& heat,
    const std::string& given, const std::string& result) const;
  void MakeFactorOfDistances();
  /// Distances from a vertex.
  /// \param positions where each vertex sees it.
  Vector<double> Distances(int vertex, const Vector<Complex>& positions);

  const FramedMesh& Surface;
  const std::vector<int> Components; ///< of vertices
  const VertexConnection Connection;
  const IntrinsicTriangulation Delaunay;
  const Vector<double> Times;
  std::unique_ptr<CholeskySolver<double>> OfFunctions;
  std::unique_ptr<CholeskySolver<Complex>> OfVectors;
  std::unique_ptr<CholeskySolver<double>> OfDistances;
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
  , Components(VertexComponents(surface.Mesh))
  , Connection(surface, context)
  , Delaunay(surface, this->Connection, context)
  , Times(TimesOf(surface.Mesh, this->Components, Checked(options.TimeStep)))
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

ParallelTransport::Internals::Heat ParallelTransport::Internals::HeatOf(const Constraints& sources) const
{
  const TriangleMesh& mesh = this->Surface.Mesh;
  Heat heat;
  heat.Directions.setZero(mesh.NumberOfVertices());
  heat.LengthsAndOnes.setZero(mesh.NumberOfVertices(), 2);
  const auto add = [&heat](int vertex, Complex direction, double length, double share)
  {
    heat.Directions[vertex] += share * direction;
    heat.LengthsAndOnes(vertex, 0) += share * length;
    heat.LengthsAndOnes(vertex, 1) += share;
  };
  const ElementNames names;
  for (const Constraint& at : sources.AtVertices)
  {
    CheckElement(at.Element, mesh.NumberOfVertices(), "vertex");
    const Complex vector =
      TangentialPart(this->Surface.Vertices, at.Element, at.Direction, at.Weight, names.Vertex(at.Element), "vertex");
    add(at.Element, vector / std::abs(vector), std::abs(vector), 1.0);
  }
  for (const Constraint& on : sources.OnFaces)
  {
    CheckElement(on.Element, mesh.NumberOfFaces(), "face");
    const Complex vector =
      TangentialPart(this->Surface.Faces, on.Element, on.Direction, on.Weight, names.Face(on.Element), "face");
    const Complex direction = vector / std::abs(vector);
    for (int h = 3 * on.Element; h < 3 * on.Element + 3; ++h)
    {
      add(mesh.Tail(h), this->Connection.TurnFromFace(h) * direction, std::abs(vector), 1.0 / 3.0);
    }
  }
  return heat;
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

std::vector<std::string> ParallelTransport::Internals::WarningsOf(const std::vector<char>& hasSource,
  const Vector<double>& heat, const std::string& given, const std::string& result) const
{
  int withoutSource = 0;
  int tooFar = 0;
  for (int vertex = 0; vertex < heat.size(); ++vertex)
  {
    const bool isReached = hasSource[this->Components[vertex]] != 0;
    withoutSource += isReached ? 0 : 1;
    tooFar += isReached && !(heat[vertex] > SmallestHeat) ? 1 : 0;
  }
  std::vector<std::string> warnings;
  if (withoutSource > 0)
  {
    warnings.push_back(std::to_string(withoutSource) + " of " + std::to_string(heat.size()) +
      " points are on components without " + given + "; " + result + " is zero there.");
  }
  if (tooFar > 0)
  {
    warnings.push_back(std::to_string(tooFar) + " of " + std::to_string(heat.size()) +
      " points are too far away for the diffusion; " + result + " is zero there. Raise the time step.");
  }
  return warnings;
}

void ParallelTransport::Internals::MakeFactorOfDistances()
{
  if (this->OfDistances)
  {
    return;
  }
  const Vector<double> forever = Vector<double>::Constant(this->Times.size(), std::numeric_limits<double>::infinity());
  SparseMatrix<double> laplacian = DiffusionOfFunctions(this->Delaunay, forever);
  // Sources sum to zero, so that a function that is held at one vertex of each component is zero there.
  for (const int vertex : FarthestVertices(Vector<double>::Zero(this->Times.size()), this->Components))
  {
    laplacian.coeffRef(vertex, vertex) += 1.0;
  }
  this->OfDistances = Factor(laplacian, this->Surface.Mesh);
}

Vector<double> ParallelTransport::Internals::Distances(int vertex, const Vector<Complex>& positions)
{
  this->MakeFactorOfDistances();
  // The distance of the head of an edge less that of its tail, as the maps at both give it; exact in the plane.
  Vector<double> source = Vector<double>::Zero(positions.size());
  VisitEdges(this->Delaunay,
    [&](int h)
    {
      const Complex tail = positions[this->Delaunay.Tail(h)];
      const Complex head = positions[this->Delaunay.Head(h)];
      const Complex fromTail = std::polar(this->Delaunay.Length(h), this->Delaunay.Direction(h));
      const Complex fromHead = -std::polar(this->Delaunay.Length(h), this->Delaunay.Arrival(h));
      const double flux = 0.5 * this->Delaunay.Weight(h) *
        (std::abs(tail - fromTail) - std::abs(tail) + std::abs(head) - std::abs(head - fromHead));
      source[this->Delaunay.Head(h)] += flux;
      source[this->Delaunay.Tail(h)] -= flux;
    });
  Vector<double> distances;
  this->OfDistances->Solve(source, distances);
  const double zero = distances[vertex];
  for (int other = 0; other < distances.size(); ++other)
  {
    const bool isReached = this->Components[other] == this->Components[vertex];
    distances[other] = isReached ? std::max(distances[other] - zero, 0.0) : 0.0;
  }
  return distances;
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
  const Internals::Heat sourcesOfHeat = of.HeatOf(sources);
  of.MakeFactors(PartOfContext(context, 0.0, 0.8));
  Vector<Complex> directions;
  CholeskySolver<double>::Columns heat;
  of.OfVectors->Solve(sourcesOfHeat.Directions, directions);
  context.Checkpoint(0.9);
  of.OfFunctions->Solve(sourcesOfHeat.LengthsAndOnes, heat);
  ++of.Counts.Solves;

  std::vector<char> hasSource(of.Components.size(), 0); // by component
  for (int vertex = 0; vertex < heat.rows(); ++vertex)
  {
    hasSource[of.Components[vertex]] |= sourcesOfHeat.LengthsAndOnes(vertex, 1) > 0.0 ? 1 : 0;
  }
  TransportedField field;
  field.Warnings = of.WarningsOf(hasSource, heat.col(1), "a direction", "the field");
  field.AtVertices.resize(heat.rows());
  for (int vertex = 0; vertex < heat.rows(); ++vertex)
  {
    const double ones = heat(vertex, 1);
    field.AtVertices[vertex] = ones > SmallestHeat ? heat(vertex, 0) / ones * UnitOf(directions[vertex]) : Complex(0.0);
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
  of.MakeFactors(PartOfContext(context, 0.0, 0.6));
  Vector<double> one = Vector<double>::Zero(size);
  one[vertex] = 1.0;
  Vector<Complex> unit = Vector<Complex>::Zero(size);
  unit[vertex] = direction / length;
  Vector<double> heat;
  Vector<Complex> reference, positions;
  of.OfFunctions->Solve(one, heat);
  of.OfVectors->Solve(unit, reference);
  of.OfVectors->Solve(SourceOfPositions(of.Delaunay, heat), positions);
  context.Checkpoint(0.7);
  for (int other = 0; other < size; ++other)
  {
    positions[other] = heat[other] > SmallestHeat ? positions[other] / heat[other] : Complex(0.0);
  }

  LogarithmicMap map;
  std::vector<char> hasSource(of.Components.size(), 0); // by component
  hasSource[of.Components[vertex]] = 1;
  map.Warnings = of.WarningsOf(hasSource, heat, "the point of the logarithmic map", "the map");
  map.Distances = of.Distances(vertex, positions);
  const int corrected = KeepWithinBounds(of.Surface.Mesh, vertex, map.Distances);
  if (corrected > MostCorrected * size)
  {
    map.Warnings.push_back("Distances of " + std::to_string(corrected) + " of " + std::to_string(size) +
      " points were off by more than 2 % of the largest and are corrected; angles there may be off, too. The triangles "
      "are too "
      "coarse or uneven for this surface: refine or remesh it.");
  }
  map.Distances[vertex] = 0.0;
  map.Angles.setZero(size);
  map.Coordinates.setZero(size);
  for (int other = 0; other < size; ++other)
  {
    const Complex turned = -UnitOf(positions[other]) * std::conj(UnitOf(reference[other]));
    if (other != vertex && turned != 0.0)
    {
      map.Angles[other] = std::arg(turned);
      map.Coordinates[other] = std::polar(map.Distances[other], map.Angles[other]);
    }
  }
  ++of.Counts.Solves;
  context.Checkpoint(1.0);
  return map;
}

const Vector<double>& ParallelTransport::Times() const
{
  return this->Internal->Times;
}

long long ParallelTransport::Bytes() const
{
  const Internals& of = *this->Internal;
  return (of.OfFunctions ? of.OfFunctions->Bytes() : 0) + (of.OfVectors ? of.OfVectors->Bytes() : 0) +
    (of.OfDistances ? of.OfDistances->Bytes() : 0);
}

ParallelTransport::StageCounts ParallelTransport::Counts() const
{
  return this->Internal->Counts;
}

}
