// Flows on surfaces whose boundary is open in some places and closed in others.

#include "Flows/FlowBoundary.h"
#include "Flows/FlowOperators.h"
#include "Flows/HodgeDecomposition.h"
#include "Operators/FaceFieldOperators.h"
#include "Support/AllIndices.h"
#include "Support/DenseAlgebra.h"
#include "Support/DisjointSets.h"
#include "Support/MeshFactory.h"
#include "Support/ReferenceOperators.h"

#include "FlowColumns.h"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <set>
#include <string>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

constexpr Complex I(0.0, 1.0);

double Norm(const FramedMesh& surface, const Vector<Complex>& X)
{
  return std::sqrt(FlowProduct(surface.Mesh.FaceAreas(), X, X));
}

/// Boundary edges whose middles are where a condition holds are open.
std::vector<char> OpenWhere(const TriangleMesh& mesh, const std::function<bool(const Vector3&)>& isOpen)
{
  std::vector<char> open(mesh.NumberOfEdges(), 0);
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    const Vector3 middle = 0.5 * (mesh.Position(mesh.Tail(h)) + mesh.Position(mesh.Head(h)));
    open[mesh.EdgeOf(h)] = mesh.Twin(h) < 0 && isOpen(middle) ? 1 : 0;
  }
  return open;
}

/// The sets of boundary vertices that closed edges join, or open ones.
struct Arcs
{
  Arcs(const TriangleMesh& mesh, const std::vector<char>& isOpen, bool areOpen)
    : Joined(mesh.NumberOfVertices())
    , IsOn(mesh.NumberOfVertices(), 0)
  {
    for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
    {
      if (mesh.Twin(h) < 0 && (isOpen[mesh.EdgeOf(h)] != 0) == areOpen)
      {
        this->Joined.Unite(mesh.Tail(h), mesh.Head(h));
        this->IsOn[mesh.Tail(h)] = this->IsOn[mesh.Head(h)] = 1;
      }
    }
  }

  DisjointSets Joined;
  std::vector<char> IsOn;
};

/// A basis of the functions that are zero at the vertices of open edges.
Eigen::MatrixXd Potentials(const TriangleMesh& mesh, const std::vector<char>& isOpen)
{
  const Arcs open(mesh, isOpen, true);
  std::vector<Vector<double>> columns;
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    if (!open.IsOn[vertex])
    {
      columns.push_back(Vector<double>::Unit(mesh.NumberOfVertices(), vertex));
    }
  }
  Eigen::MatrixXd functions(mesh.NumberOfVertices(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k)
  {
    functions.col(static_cast<Eigen::Index>(k)) = columns[k];
  }
  return functions;
}

/// A basis of the functions that are constant along closed edges.
Eigen::MatrixXd StreamFunctions(const TriangleMesh& mesh, const std::vector<char>& isOpen)
{
  Arcs closed(mesh, isOpen, false);
  const int size = mesh.NumberOfVertices();
  Eigen::MatrixXd functions = Eigen::MatrixXd::Zero(size, size);
  std::set<int> firsts;
  for (int vertex = 0; vertex < size; ++vertex)
  {
    const int first = closed.Joined.Smallest(vertex);
    functions(vertex, first) = 1.0;
    firsts.insert(first);
  }
  Eigen::MatrixXd basis(size, static_cast<Eigen::Index>(firsts.size()));
  Eigen::Index k = 0;
  for (const int first : firsts)
  {
    basis.col(k++) = functions.col(first);
  }
  return basis;
}

int RankOf(const Eigen::MatrixXd& columns)
{
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  qr.setThreshold(1e-9);
  return static_cast<int>(qr.rank());
}

Vector<Complex> RandomFlow(int faces)
{
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  Vector<Complex> flow(faces);
  for (Complex& vector : flow)
  {
    vector = { normal(random), normal(random) };
  }
  return flow;
}

/// A surface of genus g with o boundary loops that are open, all or in part.
struct PartlyOpen
{
  std::string Name;
  Surface Shape;
  std::function<bool(const Vector3&)> IsOpen;
  int Genus;
  int OpenLoops;
};

double Radius(const Vector3& p)
{
  return std::hypot(p[0], p[1]);
}

/// A torus without some faces: two holes.
Surface TorusWithHoles()
{
  Surface torus = IrregularTorus(16, 8, 3);
  std::vector<int> kept;
  for (int face = 0; face < torus.F.rows(); ++face)
  {
    double nearest = 1.0;
    for (int k = 0; k < 3; ++k)
    {
      const Vector3 corner = torus.V.row(torus.F(face, k)).transpose();
      nearest = std::min({ nearest, (corner - Vector3(1.4, 0, 0)).norm(), (corner + Vector3(1.4, 0, 0)).norm() });
    }
    if (nearest > 0.2)
    {
      kept.push_back(face);
    }
  }
  const Triangles faces = torus.F(kept, All);
  std::vector<int> numbers(torus.V.rows(), -1), used;
  torus.F = faces;
  for (int face = 0; face < faces.rows(); ++face)
  {
    for (int k = 0; k < 3; ++k)
    {
      int& number = numbers[faces(face, k)];
      if (number < 0)
      {
        number = static_cast<int>(used.size());
        used.push_back(faces(face, k));
      }
      torus.F(face, k) = number;
    }
  }
  const Points points = torus.V(used, All);
  torus.V = points;
  return torus;
}

std::vector<PartlyOpen> Shapes()
{
  const auto east = [](const Vector3& p) { return p[0] > 0.0; };
  const auto quarters = [](const Vector3& p) { return p[0] * p[1] > 0.0; };
  const auto outer = [](const Vector3& p) { return Radius(p) > 1.5; };
  const auto eastOuter = [](const Vector3& p) { return Radius(p) > 1.5 && p[0] > 0.0; };
  return { { "half of a disc", Disk(5), east, 0, 1 }, { "quarters of a disc", Disk(5), quarters, 0, 1 },
    { "annulus, outside", Annulus(16, 4), outer, 0, 1 },
    { "annulus, east of outside", Annulus(16, 4), eastOuter, 0, 1 },
    { "annulus, quarters of both", Annulus(16, 4), quarters, 0, 2 },
    { "torus with two holes, one open", TorusWithHoles(), east, 1, 1 },
    { "torus with two holes, quarters of both", TorusWithHoles(), [](const Vector3& p) { return p[1] * p[2] > 0.0; }, 1,
      2 } };
}

}

TEST(FlowBoundary, LoopsFallIntoArcsThatShareTheirEnds)
{
  const TriangleMesh mesh = Disk(5).Mesh();
  const double length = FindBoundaryLoops(mesh)[0].Length;
  const std::vector<char> isOpen = OpenWhere(mesh, [](const Vector3& p) { return p[0] * p[1] > 0.0; });
  const std::vector<BoundaryPart> parts = PartsOfBoundary(mesh, isOpen);
  ASSERT_EQ(parts.size(), 4u);
  double sum = 0.0;
  std::vector<int> visits(mesh.NumberOfVertices(), 0);
  std::vector<char> isEnd(mesh.NumberOfVertices(), 0);
  for (const BoundaryPart& part : parts)
  {
    EXPECT_FALSE(part.IsLoop);
    isEnd[part.Vertices.front()] = isEnd[part.Vertices.back()] = 1;
    sum += part.Length;
    for (std::size_t k = 0; k + 1 < part.Vertices.size(); ++k)
    {
      const int h = mesh.OutgoingHalfedge(part.Vertices[k]);
      EXPECT_EQ(mesh.Head(h), part.Vertices[k + 1]);
      EXPECT_EQ(isOpen[mesh.EdgeOf(h)] != 0, part.IsOpen);
    }
    for (const int vertex : part.OwnVertices())
    {
      ++visits[vertex];
    }
  }
  EXPECT_NEAR(sum, length, 1e-13 * length);
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    EXPECT_EQ(visits[vertex], mesh.IsBoundaryVertex(vertex) && !isEnd[vertex] ? 1 : 0);
  }
}

TEST(FlowBoundary, SpacesOfPartlyOpenBoundariesHaveTheDimensionsOfTheTable)
{
  for (const PartlyOpen& shape : Shapes())
  {
    SCOPED_TRACE(shape.Name);
    const FramedMesh surface(shape.Shape.Mesh());
    const std::vector<char> isOpen = OpenWhere(surface.Mesh, shape.IsOpen);
    HodgeDecomposition hodge(surface, FlowBoundary::Closed);
    hodge.SetBoundary(isOpen);
    const Eigen::MatrixXd G = Eigen::MatrixXd(FaceGradient(surface.Mesh, surface.Faces));
    const Eigen::MatrixXd potentials = Potentials(surface.Mesh, isOpen);
    const Eigen::MatrixXd streams = StreamFunctions(surface.Mesh, isOpen);
    const Eigen::MatrixXd gradients = Weighted(surface, G * potentials);
    const Eigen::MatrixXd turned = Weighted(surface, Turned(G * streams));
    const Eigen::MatrixXd harmonic = Weighted(surface, hodge.HarmonicBasis());
    EXPECT_EQ(harmonic.cols(), 2 * shape.Genus + shape.OpenLoops - 1);
    EXPECT_EQ(RankOf(gradients), potentials.cols());
    EXPECT_EQ(RankOf(turned), streams.cols() - 1);
    EXPECT_LT((gradients.transpose() * turned).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((gradients.transpose() * harmonic).norm(), 1e-10);
    EXPECT_LT((turned.transpose() * harmonic).norm(), 1e-10);
  }
}

TEST(FlowBoundary, PartsOfFlowsOnPartlyOpenSurfacesAreOrthogonal)
{
  for (const PartlyOpen& shape : Shapes())
  {
    SCOPED_TRACE(shape.Name);
    const FramedMesh surface(shape.Shape.Mesh());
    const Vector<double> areas = surface.Mesh.FaceAreas();
    HodgeDecomposition hodge(surface, FlowBoundary::Closed);
    hodge.SetBoundary(OpenWhere(surface.Mesh, shape.IsOpen));
    const DecomposedFlow parts = hodge.Decompose(RandomFlow(surface.Mesh.NumberOfFaces()));
    EXPECT_TRUE(parts.Warnings.empty());
    const std::vector<Vector<Complex>> all{ parts.Gradient, parts.Rotational, parts.Harmonic, parts.Residual };
    for (std::size_t a = 0; a < all.size(); ++a)
    {
      for (std::size_t b = 0; b < a; ++b)
      {
        EXPECT_LT(std::abs(FlowProduct(areas, all[a], all[b])), 1e-10 * parts.Energy) << a << " " << b;
      }
    }
    EXPECT_NEAR(parts.GradientEnergy + parts.RotationalEnergy + parts.HarmonicEnergy + parts.ResidualEnergy,
      parts.Energy, 1e-10 * parts.Energy);
  }
}

TEST(FlowBoundary, ACurrentAlongACoastWithOpenSidesIsRotational)
{
  const FramedMesh sea(PlaneGrid(12, 8).Mesh());
  const TriangleMesh& mesh = sea.Mesh;
  const double south = mesh.VertexPositions().col(1).minCoeff();
  HodgeDecomposition hodge(sea, FlowBoundary::Closed);
  hodge.SetBoundary(OpenWhere(mesh, [south](const Vector3& p) { return p[1] > south; }));
  Vector<double> psi = south - mesh.VertexPositions().col(1).array(); // it grows to the right of a flow to the east
  const Vector<Complex> current = I * GradientOnFaces(sea, psi);
  // Any potential that is zero at open sides goes into the other part.
  Vector<double> u = Vector<double>::Zero(mesh.NumberOfVertices());
  const std::vector<char> isOpen = OpenWhere(mesh, [south](const Vector3& p) { return p[1] > south; });
  const Arcs open(mesh, isOpen, true);
  for (int vertex = 0; vertex < u.size(); ++vertex)
  {
    u[vertex] = open.IsOn[vertex] ? 0.0 : std::sin(3.0 * vertex);
  }
  const Vector<Complex> spreading = GradientOnFaces(sea, u);
  const DecomposedFlow parts = hodge.Decompose(current + spreading);
  EXPECT_LT(Norm(sea, parts.Rotational - current), 1e-10 * Norm(sea, current));
  EXPECT_LT(Norm(sea, parts.Gradient - spreading), 1e-10 * Norm(sea, spreading));
  EXPECT_LT((parts.StreamFunction - psi).norm(), 1e-10 * psi.norm());
  EXPECT_LT((parts.Potential - u).norm(), 1e-10 * u.norm());
}

TEST(FlowBoundary, TheTransportBetweenTwoCoastsOfAStraitStandsInTheStreamFunction)
{
  const FramedMesh strait(PlaneGrid(12, 8).Mesh());
  const TriangleMesh& mesh = strait.Mesh;
  const double west = mesh.VertexPositions().col(0).minCoeff(), east = mesh.VertexPositions().col(0).maxCoeff();
  HodgeDecomposition hodge(strait, FlowBoundary::Closed);
  hodge.SetBoundary(OpenWhere(mesh, [&](const Vector3& p) { return p[0] == west || p[0] == east; }));
  const Vector<Complex> flow = I * GradientOnFaces(strait, -mesh.VertexPositions().col(1));
  const DecomposedFlow parts = hodge.Decompose(flow);
  ASSERT_EQ(hodge.Boundaries().size(), 4u);
  std::vector<double> ofCoasts;
  for (std::size_t k = 0; k < 4; ++k)
  {
    if (!hodge.Boundaries()[k].IsOpen)
    {
      ofCoasts.push_back(parts.StreamValues[static_cast<Eigen::Index>(k)]);
    }
  }
  ASSERT_EQ(ofCoasts.size(), 2u);
  const double width = mesh.VertexPositions().col(1).maxCoeff() - mesh.VertexPositions().col(1).minCoeff();
  EXPECT_NEAR(std::abs(ofCoasts[0] - ofCoasts[1]), width, 1e-10 * width); // at the speed 1
  EXPECT_LT(Norm(strait, parts.Rotational - flow), 1e-10 * Norm(strait, flow));
}

// The flow (1, 2) through a rectangle of 12 by 8, whose corners have one face or two. Gauss' theorem holds for any flow.
TEST(FlowBoundary, FluxAndCirculationOfArcsReachTheirEnds)
{
  for (const unsigned seed : { 1u, 2u, 3u, 4u })
  {
    const FramedMesh channel(IrregularPlane(12, 8, seed).Mesh());
    const TriangleMesh& mesh = channel.Mesh;
    const auto middle =
      (mesh.VertexPositions().colwise().maxCoeff() + mesh.VertexPositions().colwise().minCoeff()) / 2.0;
    const Vector3 centre = middle.transpose();
    HodgeDecomposition hodge(channel, FlowBoundary::Closed);
    hodge.SetBoundary(OpenWhere(mesh, [&](const Vector3& p) { return std::abs(p[0] - centre[0]) > 5.99; }));
    Vector<Complex> flow(mesh.NumberOfFaces());
    for (int face = 0; face < flow.size(); ++face)
    {
      flow[face] = channel.Faces.ToComplex(face, Vector3(1.0, 2.0, 0.0));
    }
    const FlowParts none{ false, false, false };
    const DecomposedFlow parts = hodge.Decompose(flow, none);
    ASSERT_EQ(hodge.Boundaries().size(), 4u);
    for (Eigen::Index k = 0; k < 4; ++k)
    {
      const BoundaryPart& part = hodge.Boundaries()[k];
      const Vector3 way = mesh.Position(part.Vertices.back()) - mesh.Position(part.Vertices.front());
      EXPECT_NEAR(parts.Flux[k], way.y() - 2.0 * way.x(), 1e-12); // to the right of the way
      EXPECT_NEAR(parts.Circulation[k], way.x() + 2.0 * way.y(), 1e-12);
    }
    const DecomposedFlow ofAny = hodge.Decompose(RandomFlow(mesh.NumberOfFaces()), none);
    double divergence = 0.0, vorticity = 0.0; // inside
    for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
    {
      divergence += mesh.IsBoundaryVertex(vertex) ? 0.0 : ofAny.Derivatives.Divergence[vertex];
      vorticity += mesh.IsBoundaryVertex(vertex) ? 0.0 : ofAny.Derivatives.Vorticity[vertex];
    }
    EXPECT_NEAR(ofAny.Flux.sum(), divergence, 1e-12);
    EXPECT_NEAR(ofAny.Circulation.sum(), vorticity, 1e-12);
  }
}

TEST(FlowBoundary, TheSteeringFlowIsTheWindThatAStormStandsIn)
{
  const FramedMesh region(PlaneGrid(12, 8).Mesh());
  const TriangleMesh& mesh = region.Mesh;
  Vector<double> u(mesh.NumberOfVertices()), psi(mesh.NumberOfVertices());
  for (int vertex = 0; vertex < u.size(); ++vertex)
  {
    u[vertex] = mesh.IsBoundaryVertex(vertex) ? 0.0 : std::sin(3.0 * vertex);
    psi[vertex] = mesh.IsBoundaryVertex(vertex) ? 0.0 : std::cos(5.0 * vertex);
  }
  const Vector<double> linear = 5.0 * mesh.VertexPositions().col(0) + 2.0 * mesh.VertexPositions().col(1);
  const Vector<Complex> wind = GradientOnFaces(region, linear);
  const Vector<Complex> flow = wind + GradientOnFaces(region, u) + I * GradientOnFaces(region, psi);
  const double middle = mesh.VertexPositions().col(1).mean();
  HodgeDecomposition hodge(region, FlowBoundary::Closed);
  for (const std::vector<char>& isOpen : { OpenEdges(mesh, FlowBoundary::Closed), OpenEdges(mesh, FlowBoundary::Open),
         OpenWhere(mesh, [middle](const Vector3& p) { return p[1] > middle; }) })
  {
    hodge.SetBoundary(isOpen);
    const DecomposedFlow parts = hodge.Decompose(flow, { false, false, false, true });
    EXPECT_EQ(parts.Gradient.size() + parts.Rotational.size() + parts.Harmonic.size(), 0);
    EXPECT_LT(Norm(region, parts.Steering - wind), 1e-10 * Norm(region, wind));
  }
}
