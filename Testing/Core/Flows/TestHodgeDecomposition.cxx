// Flows as sums of gradients, turned gradients, harmonic fields, and the rest.

#include "Flows/HodgeDecomposition.h"

#include "Flows/FittedDerivatives.h"

#include "Analysis/HarmonicForms.h"
#include "Flows/FlowOperators.h"
#include "Operators/FaceFieldOperators.h"
#include "Support/AllIndices.h"
#include "Support/ComplexPairs.h"
#include "Support/Errors.h"
#include "Support/MeshFactory.h"
#include "Support/ReferenceOperators.h"
#include "Support/TbbContext.h"

#include "FlowColumns.h"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

constexpr Complex I(0.0, 1.0);
using VectorAt = std::function<Vector3(const Vector3&)>;

SolverOptions OptionsOf(SolverKind kind)
{
  SolverOptions options;
  options.Kind = kind;
  return options;
}

/// The surface without the faces of which a corner is nearer to a centre than a radius.
Surface WithHoles(const Surface& surface, const std::vector<Vector3>& centres, double radius)
{
  std::vector<int> kept;
  std::vector<int> numbers(surface.V.rows(), -1);
  int vertices = 0;
  for (int face = 0; face < surface.F.rows(); ++face)
  {
    bool isInHole = false;
    for (const Vector3& centre : centres)
    {
      for (int k = 0; k < 3; ++k)
      {
        isInHole |= (Vector3(surface.V.row(surface.F(face, k))) - centre).norm() < radius;
      }
    }
    if (!isInHole)
    {
      kept.push_back(face);
      for (int k = 0; k < 3; ++k)
      {
        int& number = numbers[surface.F(face, k)];
        number = number < 0 ? vertices++ : number;
      }
    }
  }
  Surface result{ Points(vertices, 3), Triangles(kept.size(), 3) };
  for (int vertex = 0; vertex < surface.V.rows(); ++vertex)
  {
    if (numbers[vertex] >= 0)
    {
      result.V.row(numbers[vertex]) = surface.V.row(vertex);
    }
  }
  for (std::size_t face = 0; face < kept.size(); ++face)
  {
    for (int k = 0; k < 3; ++k)
    {
      result.F(face, k) = numbers[surface.F(kept[face], k)];
    }
  }
  return result;
}

const std::vector<Vector3> PlacesOfContinents{ { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { -0.7, -0.7, 0 },
  { 0, -0.6, -0.8 } };

Surface SphereWithContinents(int subdivisions)
{
  return WithHoles(IrregularSphere(subdivisions, 8), PlacesOfContinents, 0.35);
}

struct NamedFlow
{
  std::string Name;
  Surface Shape;
  int DimensionClosed; ///< of harmonic parts
  int DimensionOpen;
};

std::vector<NamedFlow> Shapes()
{
  return { { "disc", Disk(5), 0, 0 }, { "annulus", Annulus(16, 4), 0, 1 }, { "torus", IrregularTorus(14, 8, 3), 2, 2 },
    { "torus with two holes", WithHoles(IrregularTorus(20, 12, 3), { { 1.4, 0, 0 }, { -1.4, 0, 0 } }, 0.3), 2, 3 },
    { "double torus", DoubleTorus(2), 4, 4 }, { "continents", SphereWithContinents(3), 0, 4 },
    { "annulus and torus", Union(Annulus(12, 3), IrregularTorus(12, 8, 2), { 6, 0, 0 }), 2, 3 } };
}

Vector<Complex> RandomFlow(int faces, unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Vector<Complex> flow(faces);
  for (Complex& vector : flow)
  {
    vector = { normal(random), normal(random) };
  }
  return flow;
}

/// Its tangential part at the centres of the faces, moved to the surface.
Vector<Complex> Sampled(const FramedMesh& surface, const VectorAt& field, const VectorAt& toSurface)
{
  Vector<Complex> flow(surface.Mesh.NumberOfFaces());
  for (int face = 0; face < flow.size(); ++face)
  {
    Vector3 centre = Vector3::Zero();
    for (int k = 0; k < 3; ++k)
    {
      centre += surface.Mesh.Position(surface.Mesh.FaceCorners()(face, k)) / 3.0;
    }
    flow[face] = surface.Faces.ToComplex(face, field(toSurface(centre)));
  }
  return flow;
}

Vector3 ToSphere(const Vector3& p)
{
  return p.normalized();
}

Vector3 Stay(const Vector3& p)
{
  return p;
}

double Norm(const FramedMesh& surface, const Vector<Complex>& X)
{
  return std::sqrt(FlowProduct(surface.Mesh.FaceAreas(), X, X));
}

double RelativeError(const Vector<double>& found, const Vector<double>& exact)
{
  return (found - exact).norm() / exact.norm();
}

/// log2 of how much each refinement gains, over two of them.
double Order(const std::array<double, 3>& errors)
{
  return 0.5 * std::log2(errors[0] / errors[2]);
}

template <class Error>
double OrderOver(const std::array<int, 3>& levels, const Error& error)
{
  return Order({ error(levels[0]), error(levels[1]), error(levels[2]) });
}

Vector<double> AtVertices(const TriangleMesh& mesh, const std::function<double(const Vector3&)>& function)
{
  Vector<double> values(mesh.NumberOfVertices());
  for (int vertex = 0; vertex < values.size(); ++vertex)
  {
    values[vertex] = function(mesh.Position(vertex));
  }
  return values;
}

/// A basis of functions at vertices: all, or those that are constant on loops, or zero there.
Eigen::MatrixXd FunctionsAtVertices(const TriangleMesh& mesh, bool isConstantOnLoops, bool isZeroOnLoops)
{
  std::vector<Vector<double>> columns;
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    if (!mesh.IsBoundaryVertex(vertex) || (!isConstantOnLoops && !isZeroOnLoops))
    {
      columns.push_back(Vector<double>::Unit(mesh.NumberOfVertices(), vertex));
    }
  }
  if (isConstantOnLoops)
  {
    for (const BoundaryLoop& loop : FindBoundaryLoops(mesh))
    {
      columns.push_back(Vector<double>::Zero(mesh.NumberOfVertices()));
      columns.back()(loop.Vertices).setOnes();
    }
  }
  Eigen::MatrixXd functions(mesh.NumberOfVertices(), columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k)
  {
    functions.col(k) = columns[k];
  }
  return functions;
}

int RankOf(const Eigen::MatrixXd& columns)
{
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  qr.setThreshold(1e-9);
  return static_cast<int>(qr.rank());
}

int NumberOfComponents(const TriangleMesh& mesh)
{
  const std::vector<int> components = FaceComponents(mesh);
  return *std::max_element(components.begin(), components.end()) + 1;
}

/// The spherical harmonic z Re (x + i y)^3 of degree 4, extended to space as a polynomial without change of its Laplacian, 0.
double Wave(const Vector3& p)
{
  return p[2] * (p[0] * p[0] * p[0] - 3.0 * p[0] * p[1] * p[1]);
}

/// On the unit sphere, where the quarter turn of the gradient is the product with the normal.
Vector3 VelocityOfWave(const Vector3& p)
{
  const Vector3 gradient(
    3.0 * p[2] * (p[0] * p[0] - p[1] * p[1]), -6.0 * p[0] * p[1] * p[2], p[0] * p[0] * p[0] - 3.0 * p[0] * p[1] * p[1]);
  return p.cross(gradient);
}

struct ErrorsOfWave
{
  double Stream;
  double Vorticity;
  double Vectors;
};

ErrorsOfWave ErrorsOn(int subdivisions)
{
  const FramedMesh sphere(IrregularSphere(subdivisions, 4, 0.15).Mesh());
  const Vector<Complex> flow = Sampled(sphere, VelocityOfWave, ToSphere);
  HodgeDecomposition hodge(sphere, FlowBoundary::Closed);
  const DecomposedFlow parts = hodge.Decompose(flow);
  const Vector<double> psi = AtVertices(sphere.Mesh, Wave);
  Points vectors(flow.size(), 3);
  for (int face = 0; face < flow.size(); ++face)
  {
    vectors.row(face) = sphere.Faces.ToVector(face, flow[face]).transpose();
  }
  const SurfaceRelation relation = SurfaceRelation::OneToOne(sphere.Mesh);
  const Vector<double> vorticity =
    DerivativesOfCellVectors(sphere, relation, vectors, CellCentres(sphere.Mesh, relation)).Vorticity;
  return { RelativeError(parts.StreamFunction, psi), RelativeError(vorticity, -20.0 * psi),
    Norm(sphere, parts.Rotational - flow) / Norm(sphere, flow) };
}

/// A ring between circles around two points of the unit sphere, by a Moebius map and a mirrored stereographic
/// projection of an annulus, so that normals point outwards.
struct TwoContinents
{
  explicit TwoContinents(int rings)
    : On(Shape(rings).Mesh())
  {
  }

  static Complex Mapped(Complex w) { return (w + 0.4) / (1.0 - 0.3 * w); }
  static Complex Unmapped(Complex z) { return (z - 0.4) / (1.0 + 0.3 * z); }
  static Complex ToPlane(const Vector3& p) { return Complex(p[0], -p[1]) / (1.0 - p[2]); }

  static Surface Shape(int rings)
  {
    Surface shape = Annulus(4 * rings, rings);
    for (int vertex = 0; vertex < shape.V.rows(); ++vertex)
    {
      const Complex z = Mapped(Complex(shape.V(vertex, 0), shape.V(vertex, 1)));
      const double square = std::norm(z);
      shape.V.row(vertex) << 2.0 * z.real() / (square + 1.0), -2.0 * z.imag() / (square + 1.0),
        (square - 1.0) / (square + 1.0);
    }
    return shape;
  }

  /// The stream function of a vortex pair, whose vortices lie within the continents.
  static double Stream(const Vector3& p) { return std::log(std::abs(Unmapped(ToPlane(p)))); }

  static Vector3 Velocity(const Vector3& p)
  {
    constexpr double Step = 1e-5;
    Vector3 gradient;
    for (int k = 0; k < 3; ++k)
    {
      const Vector3 step = Step * Vector3::Unit(k);
      gradient[k] = (Stream((p + step).normalized()) - Stream((p - step).normalized())) / (2.0 * Step);
    }
    return p.cross(gradient);
  }

  FramedMesh On;
};

}

TEST(HodgeDecomposition, PartsSumToTheFlowAndAreOrthogonal)
{
  for (const NamedFlow& named : Shapes())
  {
    SCOPED_TRACE(named.Name);
    const FramedMesh surface(named.Shape.Mesh());
    const Vector<double> areas = surface.Mesh.FaceAreas();
    const Vector<Complex> flow = RandomFlow(surface.Mesh.NumberOfFaces(), 5);
    for (const FlowBoundary boundary : { FlowBoundary::Closed, FlowBoundary::Open })
    {
      for (const SolverKind kind : { SolverKind::Cholesky, SolverKind::ConjugateGradients })
      {
        HodgeDecomposition hodge(surface, boundary, OptionsOf(kind));
        const DecomposedFlow parts = hodge.Decompose(flow);
        EXPECT_TRUE(parts.Converged);
        EXPECT_TRUE(parts.Warnings.empty());
        const std::vector<Vector<Complex>> all{ parts.Gradient, parts.Rotational, parts.Harmonic, parts.Residual };
        const Vector<Complex> sum = all[0] + all[1] + all[2] + all[3];
        EXPECT_LT(Norm(surface, sum - flow), 1e-14 * Norm(surface, flow));
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
  }
}

TEST(HodgeDecomposition, SpacesHaveTheDimensionsOfTheTableAndFillTheirPlace)
{
  for (const NamedFlow& named : Shapes())
  {
    SCOPED_TRACE(named.Name);
    const FramedMesh surface(named.Shape.Mesh());
    const TriangleMesh& mesh = surface.Mesh;
    if (mesh.NumberOfFaces() > 500)
    {
      continue; // ranks are dense
    }
    const Eigen::MatrixXd G = Eigen::MatrixXd(FaceGradient(mesh, surface.Faces));
    for (const FlowBoundary boundary : { FlowBoundary::Closed, FlowBoundary::Open })
    {
      const bool isClosed = boundary == FlowBoundary::Closed;
      HodgeDecomposition hodge(surface, boundary);
      const Eigen::MatrixXd gradients = Weighted(surface, G * FunctionsAtVertices(mesh, false, !isClosed));
      const Eigen::MatrixXd turned = Weighted(surface, Turned(G * FunctionsAtVertices(mesh, isClosed, false)));
      const Eigen::MatrixXd harmonic = Weighted(surface, hodge.HarmonicBasis());
      EXPECT_EQ(harmonic.cols(), isClosed ? named.DimensionClosed : named.DimensionOpen);
      EXPECT_LT((gradients.transpose() * turned).cwiseAbs().maxCoeff(), 1e-12);
      EXPECT_LT((gradients.transpose() * harmonic).norm(), 1e-10);
      EXPECT_LT((turned.transpose() * harmonic).norm(), 1e-10);
      EXPECT_LT(
        (harmonic.transpose() * harmonic - Eigen::MatrixXd::Identity(harmonic.cols(), harmonic.cols())).norm(), 1e-10);

      // By the number of values that functions have, less a constant where they are not held.
      int closedComponents = NumberOfComponents(mesh);
      const std::vector<BoundaryLoop> loops = FindBoundaryLoops(mesh);
      int inner = mesh.NumberOfVertices();
      std::vector<char> hasBoundary(closedComponents, 0);
      for (const BoundaryLoop& loop : loops)
      {
        inner -= static_cast<int>(loop.Vertices.size());
        hasBoundary[loop.Component] = 1;
      }
      const int components = closedComponents;
      closedComponents -= static_cast<int>(std::count(hasBoundary.begin(), hasBoundary.end(), 1));
      const int free = mesh.NumberOfVertices() - components;
      const int held = inner - closedComponents;
      const int onLoops = inner + static_cast<int>(loops.size()) - components;
      EXPECT_EQ(RankOf(gradients), isClosed ? free : held);
      EXPECT_EQ(RankOf(turned), isClosed ? onLoops : free);
    }
  }
}

TEST(HodgeDecomposition, HarmonicBasisHasNeitherDivergenceNorCurl)
{
  const FramedMesh torus(WithHoles(IrregularTorus(20, 12, 3), { { 1.4, 0, 0 }, { -1.4, 0, 0 } }, 0.3).Mesh());
  HodgeDecomposition closed(torus, FlowBoundary::Closed);
  const Eigen::MatrixXd& basis = closed.HarmonicBasis();
  EXPECT_LT((FaceDivergence(torus.Mesh, torus.Faces) * basis).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT((FaceCurl(torus.Mesh, torus.Faces) * basis).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(HodgeDecomposition, APlantedStreamFunctionAmongFiveContinentsIsFound)
{
  const FramedMesh sphere(SphereWithContinents(4).Mesh());
  Vector<double> psi = AtVertices(sphere.Mesh, [](const Vector3& p) { return std::sin(3.0 * p[0]) + p[1] * p[2]; });
  const std::vector<BoundaryLoop> loops = FindBoundaryLoops(sphere.Mesh);
  ASSERT_EQ(loops.size(), 5u);
  const double values[] = { 0.0, 1.5, -2.0, 0.7, 3.0 };
  for (std::size_t k = 0; k < loops.size(); ++k)
  {
    psi(loops[k].Vertices).setConstant(values[k]);
  }
  const Vector<double> u = AtVertices(sphere.Mesh, [](const Vector3& p) { return std::cos(2.0 * p[2]) + p[0]; });
  const Vector<Complex> rotational = I * GradientOnFaces(sphere, psi);
  const Vector<Complex> gradient = GradientOnFaces(sphere, u);
  for (const SolverKind kind : { SolverKind::Cholesky, SolverKind::ConjugateGradients })
  {
    HodgeDecomposition hodge(sphere, FlowBoundary::Closed, OptionsOf(kind));
    const DecomposedFlow parts = hodge.Decompose(rotational + gradient);
    EXPECT_LT(RelativeError(parts.StreamFunction, psi), 1e-10);
    EXPECT_LT(Norm(sphere, parts.Rotational - rotational), 1e-10 * Norm(sphere, rotational));
    EXPECT_LT(Norm(sphere, parts.Gradient - gradient), 1e-10 * Norm(sphere, gradient));
    EXPECT_LT(parts.ResidualEnergy, 1e-20 * parts.Energy);
    for (std::size_t k = 0; k < loops.size(); ++k)
    {
      EXPECT_NEAR(parts.StreamValues[k], values[k], 1e-9);
    }
  }
}

TEST(HodgeDecomposition, TheRotationalPartHasTheCirculationAroundEachCoast)
{
  const FramedMesh sphere(SphereWithContinents(4).Mesh());
  const Vector<Complex> flow = RandomFlow(sphere.Mesh.NumberOfFaces(), 9);
  HodgeDecomposition closed(sphere, FlowBoundary::Closed);
  const DecomposedFlow parts = closed.Decompose(flow);
  const DecomposedFlow ofRotational = closed.Decompose(parts.Rotational);
  const DecomposedFlow ofGradient = closed.Decompose(parts.Gradient);
  const double scale = parts.Circulation.cwiseAbs().maxCoeff();
  EXPECT_GT(scale, 0.1);
  EXPECT_LT((ofRotational.Circulation - parts.Circulation).cwiseAbs().maxCoeff(), 1e-10 * scale);
  EXPECT_LT(ofGradient.Circulation.cwiseAbs().maxCoeff(), 1e-12 * scale);
  EXPECT_LT((ofGradient.Flux - parts.Flux).cwiseAbs().maxCoeff(), 1e-10 * scale);
  EXPECT_LT(ofRotational.Flux.cwiseAbs().maxCoeff(), 1e-12 * scale);

  // Stokes and Gauss: the sum over inner vertices goes along, and through, the boundary.
  const Vector<double> vorticity = IntegratedDerivatives(sphere, flow).Vorticity;
  double inner = 0.0;
  for (int vertex = 0; vertex < vorticity.size(); ++vertex)
  {
    inner += sphere.Mesh.IsBoundaryVertex(vertex) ? 0.0 : vorticity[vertex];
  }
  EXPECT_NEAR(parts.Circulation.sum(), inner, 1e-12 * vorticity.cwiseAbs().sum());
}

TEST(HodgeDecomposition, SolidBodyRotationIsAStreamFunctionAlone)
{
  const auto error = [](int subdivisions)
  {
    const FramedMesh sphere(IrregularSphere(subdivisions, 4).Mesh());
    // Eastward with the speed cos(latitude): psi = -sin(latitude), as psi grows to the right of the flow.
    const Vector<Complex> flow = Sampled(
      sphere, [](const Vector3& p) { return Vector3(-p[1], p[0], 0.0); }, ToSphere);
    HodgeDecomposition hodge(sphere, FlowBoundary::Closed);
    const DecomposedFlow parts = hodge.Decompose(flow);
    EXPECT_GT(parts.RotationalEnergy, 0.95 * parts.Energy);
    return RelativeError(parts.StreamFunction, -sphere.Mesh.VertexPositions().col(2));
  };
  EXPECT_GT(OrderOver({ 2, 3, 4 }, error), 1.8);
}

TEST(HodgeDecomposition, RossbyHaurwitzWaveOfDegreeFourConverges)
{
  const std::array<ErrorsOfWave, 3> levels{ ErrorsOn(3), ErrorsOn(4), ErrorsOn(5) };
  const auto order = [&](double ErrorsOfWave::*of) { return Order({ levels[0].*of, levels[1].*of, levels[2].*of }); };
  EXPECT_GT(order(&ErrorsOfWave::Stream), 1.8) << levels[2].Stream;
  EXPECT_GT(order(&ErrorsOfWave::Vectors), 0.9) << levels[2].Vectors;
  EXPECT_GT(order(&ErrorsOfWave::Vorticity), 0.9) << levels[2].Vorticity;
  EXPECT_LT(levels[2].Vorticity, 0.05);
}

TEST(HodgeDecomposition, PotentialFlowThroughAnAnnulusHasItsCirculationAndTransport)
{
  const auto errorsOf = [](int rings)
  {
    const FramedMesh ring(Annulus(6 * rings, rings).Mesh());
    const Vector<Complex> flow = Sampled(
      ring, [](const Vector3& p) { return Vector3(Vector3(-p[1], p[0], 0.0) / p.squaredNorm()); }, Stay);
    HodgeDecomposition hodge(ring, FlowBoundary::Closed);
    const DecomposedFlow parts = hodge.Decompose(flow);
    EXPECT_EQ(parts.StreamValues[0], 0.0); // the outer circle is longer
    return std::array<double, 4>{ std::abs(parts.Circulation[0] - 2.0 * Pi), std::abs(parts.Circulation[1] + 2.0 * Pi),
      std::abs(parts.StreamValues[1] + std::log(2.0)), Norm(ring, parts.Rotational - flow) };
  };
  const std::array<double, 4> coarse = errorsOf(8);
  const std::array<double, 4> middle = errorsOf(16);
  const std::array<double, 4> fine = errorsOf(32);
  EXPECT_GT(Order({ coarse[0], middle[0], fine[0] }), 1.8);
  EXPECT_GT(Order({ coarse[1], middle[1], fine[1] }), 1.8);
  EXPECT_GT(Order({ coarse[2], middle[2], fine[2] }), 1.8);
  EXPECT_GT(Order({ coarse[3], middle[3], fine[3] }), 0.9);
}

TEST(HodgeDecomposition, RadialFlowThroughAnOpenAnnulusIsHarmonic)
{
  const auto error = [](int rings)
  {
    const FramedMesh ring(Annulus(6 * rings, rings).Mesh());
    const Vector<Complex> flow = Sampled(
      ring, [](const Vector3& p) { return Vector3(p / p.squaredNorm()); }, Stay);
    HodgeDecomposition hodge(ring, FlowBoundary::Open);
    const DecomposedFlow parts = hodge.Decompose(flow);
    EXPECT_NEAR(parts.Flux[0], 2.0 * Pi, 0.1);
    EXPECT_NEAR(parts.Flux[1], -2.0 * Pi, 0.1);
    return Norm(ring, parts.Harmonic - flow) / Norm(ring, flow);
  };
  EXPECT_GT(OrderOver({ 8, 16, 32 }, error), 0.9);
}

TEST(HodgeDecomposition, ADipoleBetweenTwoCircularContinentsConverges)
{
  const auto errorsOf = [](int rings)
  {
    const TwoContinents sphere(rings);
    const Vector<Complex> flow = Sampled(sphere.On, &TwoContinents::Velocity, ToSphere);
    HodgeDecomposition hodge(sphere.On, FlowBoundary::Closed);
    const DecomposedFlow parts = hodge.Decompose(flow);
    Vector<double> psi = AtVertices(sphere.On.Mesh, &TwoContinents::Stream);
    psi.array() -= psi[hodge.Boundaries()[0].Vertices[0]];
    return std::array<double, 3>{ RelativeError(parts.StreamFunction, psi),
      std::abs(std::abs(parts.StreamValues[1]) - std::log(2.0)), std::abs(std::abs(parts.Circulation[0]) - 2.0 * Pi) };
  };
  const std::array<double, 3> coarse = errorsOf(8);
  const std::array<double, 3> middle = errorsOf(16);
  const std::array<double, 3> fine = errorsOf(32);
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_GT(Order({ coarse[k], middle[k], fine[k] }), 1.7) << k << ": " << fine[k];
  }
}

TEST(HodgeDecomposition, HarmonicFieldsOfATorusOfRevolutionConverge)
{
  const auto ring = [](const Vector3& p) { return std::hypot(p[0], p[1]); };
  const auto toTorus = [&](const Vector3& p)
  {
    const Vector3 middle = Vector3(p[0], p[1], 0.0) / ring(p);
    return Vector3(middle + 0.4 * (p - middle).normalized());
  };
  const auto field = [&](const Vector3& p)
  {
    const Vector3 middle = Vector3(p[0], p[1], 0.0) / ring(p);
    const Vector3 normal = (p - middle).normalized();
    const Vector3 along = Vector3(-p[1], p[0], 0.0) / ring(p);
    return Vector3((along + 2.0 * normal.cross(along)) / ring(p)); // both have neither divergence nor curl
  };
  const auto error = [&](int n)
  {
    const FramedMesh torus(IrregularTorus(5 * n, 2 * n, 6).Mesh());
    const Vector<Complex> flow = Sampled(torus, field, toTorus);
    HodgeDecomposition hodge(torus, FlowBoundary::Closed);
    const DecomposedFlow parts = hodge.Decompose(flow);
    EXPECT_EQ(parts.Coefficients.size(), 2);
    return Norm(torus, parts.Harmonic - flow) / Norm(torus, flow);
  };
  EXPECT_GT(OrderOver({ 6, 12, 24 }, error), 0.9);
}

TEST(HodgeDecomposition, ATimeSeriesSetsUpOnce)
{
  const FramedMesh torus(WithHoles(IrregularTorus(20, 12, 3), { { 1.4, 0, 0 }, { -1.4, 0, 0 } }, 0.3).Mesh());
  for (const FlowBoundary boundary : { FlowBoundary::Closed, FlowBoundary::Open })
  {
    HodgeDecomposition hodge(torus, boundary);
    EXPECT_EQ(hodge.Counts().Setups, 0);
    for (unsigned step = 0; step < 4; ++step)
    {
      hodge.Decompose(RandomFlow(torus.Mesh.NumberOfFaces(), step));
    }
    EXPECT_EQ(hodge.Counts().Setups, 1);
    EXPECT_EQ(hodge.Counts().Bases, boundary == FlowBoundary::Closed ? 2 : 1);
    EXPECT_EQ(hodge.Counts().Solves, 8);
    const Vector<Complex> flow = RandomFlow(torus.Mesh.NumberOfFaces(), 1);
    HodgeDecomposition fresh(torus, boundary);
    EXPECT_EQ(hodge.Decompose(flow).Residual, fresh.Decompose(flow).Residual);
  }
}

TEST(HodgeDecomposition, AnotherBoundaryNeedsNoOtherSetup)
{
  const FramedMesh torus(WithHoles(IrregularTorus(20, 12, 3), { { 1.4, 0, 0 }, { -1.4, 0, 0 } }, 0.3).Mesh());
  const Vector<Complex> flow = RandomFlow(torus.Mesh.NumberOfFaces(), 1);
  HodgeDecomposition hodge(torus, FlowBoundary::Closed);
  hodge.Decompose(flow);
  hodge.SetBoundary(FlowBoundary::Open);
  const DecomposedFlow parts = hodge.Decompose(flow);
  EXPECT_EQ(hodge.Counts().Setups, 1);
  HodgeDecomposition fresh(torus, FlowBoundary::Open);
  const DecomposedFlow expected = fresh.Decompose(flow);
  EXPECT_EQ(parts.Coefficients.size(), 3);
  EXPECT_LT(Norm(torus, parts.Residual - expected.Residual), 1e-9);
  EXPECT_LT(Norm(torus, parts.Harmonic - expected.Harmonic), 1e-9);
}

TEST(HodgeDecomposition, DerivativesAloneTakeNoSolve)
{
  const FramedMesh torus(IrregularTorus(20, 12, 3).Mesh());
  const Vector<Complex> flow = RandomFlow(torus.Mesh.NumberOfFaces(), 1);
  HodgeDecomposition hodge(torus, FlowBoundary::Closed);
  const DecomposedFlow parts = hodge.Decompose(flow, { false, false, false });
  EXPECT_EQ(parts.Derivatives.Divergence, IntegratedDerivatives(torus, flow).Divergence);
  EXPECT_EQ(hodge.Counts().Setups + hodge.Counts().Bases + hodge.Counts().Solves, 0);
}

TEST(HodgeDecomposition, EachPartIsTheSameWithoutTheOthers)
{
  const FramedMesh torus(WithHoles(IrregularTorus(20, 12, 3), { { 1.4, 0, 0 }, { -1.4, 0, 0 } }, 0.3).Mesh());
  const Vector<Complex> flow = RandomFlow(torus.Mesh.NumberOfFaces(), 1);
  HodgeDecomposition all(torus, FlowBoundary::Closed);
  const DecomposedFlow parts = all.Decompose(flow);
  HodgeDecomposition some(torus, FlowBoundary::Closed);
  EXPECT_LT(Norm(torus, some.Decompose(flow, { true, false, false }).Gradient - parts.Gradient), 1e-9);
  EXPECT_EQ(some.Counts().Solves, 1);
  EXPECT_LT(Norm(torus, some.Decompose(flow, { false, true, false }).Rotational - parts.Rotational), 1e-9);
  const DecomposedFlow harmonic = some.Decompose(flow, { false, false, true });
  EXPECT_LT(Norm(torus, harmonic.Harmonic - parts.Harmonic), 1e-9);
  EXPECT_LT(Norm(torus, harmonic.Harmonic + harmonic.Residual - flow), 1e-12);
  EXPECT_EQ(some.Counts().Solves, 2);
  HodgeDecomposition none(torus, FlowBoundary::Closed);
  EXPECT_EQ(none.Decompose(flow, { false, false, false }).Circulation, parts.Circulation);
  EXPECT_EQ(none.Counts().Setups, 0);
}

TEST(HodgeDecomposition, BitsDoNotDependOnThreads)
{
  const FramedMesh torus(IrregularTorus(120, 60, 3).Mesh());
  const Vector<Complex> flow = RandomFlow(torus.Mesh.NumberOfFaces(), 1);
  HodgeDecomposition one(torus, FlowBoundary::Closed, OptionsOf(SolverKind::ConjugateGradients));
  HodgeDecomposition four(torus, FlowBoundary::Closed, OptionsOf(SolverKind::ConjugateGradients));
  EXPECT_EQ(one.Decompose(flow).Residual, four.Decompose(flow, {}, { 1e-11, 200 }, TbbContext(4)).Residual);
}

TEST(HodgeDecomposition, DegenerateFacesAreNoObstacle)
{
  const FramedMesh sphere(SphereWithZeroAreaFaces(3, 5).Mesh());
  const Vector<Complex> flow = Sampled(sphere, VelocityOfWave, ToSphere);
  HodgeDecomposition hodge(sphere, FlowBoundary::Closed);
  const DecomposedFlow parts = hodge.Decompose(flow);
  EXPECT_TRUE(parts.StreamFunction.allFinite());
  EXPECT_TRUE(parts.Residual.allFinite());
  EXPECT_LT(RelativeError(parts.StreamFunction, AtVertices(sphere.Mesh, Wave)), 0.1);
}

TEST(HodgeDecomposition, SaysWhereTrianglesHaveWideAngles)
{
  for (const double shear : { 0.0, 7.0 })
  {
    Surface surface = PlaneGrid(20, 20);
    surface.V.col(0) += shear * surface.V.col(1);
    const FramedMesh plane(surface.Mesh());
    HodgeDecomposition hodge(plane, FlowBoundary::Closed);
    const Vector<Complex> flow = Vector<Complex>::Ones(plane.Mesh.NumberOfFaces());
    EXPECT_TRUE(hodge.Decompose(flow, { false, false, false }).Warnings.empty());
    const std::vector<std::string> warnings = hodge.Decompose(flow).Warnings;
    ASSERT_EQ(warnings.size(), shear > 0.0 ? 1u : 0u);
    if (shear > 0.0)
    {
      EXPECT_EQ(warnings[0],
        "100 % of the surface have triangles with an angle above 150 degrees, where parts are as inaccurate as on "
        "triangles 7.1 times as "
        "large; triangulate its points anew");
    }
  }
}

TEST(HodgeDecomposition, WrongFlowsAreNamed)
{
  const FramedMesh sphere(Icosphere(1).Mesh());
  HodgeDecomposition hodge(sphere, FlowBoundary::Closed);
  EXPECT_THROW(hodge.Decompose(Vector<Complex>::Zero(3)), InvalidInput);
  Vector<Complex> flow = Vector<Complex>::Zero(80);
  EXPECT_EQ(hodge.Decompose(flow).Energy, 0.0);
  flow[7] = std::nan("");
  try
  {
    hodge.Decompose(flow);
    FAIL();
  }
  catch (const InvalidInput& error)
  {
    EXPECT_NE(std::string(error.what()).find("face 7"), std::string::npos);
  }
}
