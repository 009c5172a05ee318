#include "Singularities/TrivialConnection.h"

#include "Mesh/FramedMesh.h"
#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace dmg;
using namespace dmg::test;

TEST(TrivialConnection, NearestIntegersAreBestInEachNumber)
{
  // x = (0.4, 0.4) rounds to (0, 0), of energy 2 (0.16 + 0.9 * 0.16) = 0.608; of all integers (1, 0) and (0, 1) have the
  // least, 0.36 + 0.16 - 1.8 * 0.24 = 0.088.
  Eigen::MatrixXd energy(2, 2);
  energy << 1.0, 0.9, 0.9, 1.0;
  const Vector<double> n = NearestIntegers(energy, Vector<double>::Constant(2, 0.4));
  EXPECT_EQ(n, (Vector<double>(2) << 1.0, 0.0).finished());
  EXPECT_EQ(NearestIntegers(Eigen::MatrixXd::Identity(1, 1), Vector<double>::Constant(1, -2.4))[0], -2.0);
  EXPECT_EQ(NearestIntegers(Eigen::MatrixXd(0, 0), Vector<double>()).size(), 0);
}

// Sums around vertices are what singularities are: they must not change, and no edge may have more than the limit.
TEST(TrivialConnection, LimitedRotationHasTheSameSums)
{
  const TriangleMesh mesh = Icosphere(2).Mesh();
  const auto sums = [&mesh](const Vector<double>& rotation)
  {
    Vector<double> sums(mesh.NumberOfVertices());
    for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
    {
      double sum = 0.0;
      mesh.VisitFan(vertex,
        [&](int h)
        {
          const int edge = mesh.EdgeOf(h);
          sum -= (mesh.HalfedgeOf(edge) == h ? 1.0 : -1.0) * rotation[edge];
        });
      sums[vertex] = sum;
    }
    return sums;
  };
  Vector<double> rotation = Vector<double>::Zero(mesh.NumberOfEdges());
  rotation[17] = 1.5;
  rotation[18] = -1.1;
  rotation[200] = 0.9;
  const Vector<double> before = sums(rotation);
  Vector<double> limited = rotation;
  LimitRotation(mesh, 0.75, limited);
  EXPECT_LE(limited.cwiseAbs().maxCoeff(), 0.75 * (1.0 + 1e-11));
  EXPECT_LT((sums(limited) - before).cwiseAbs().maxCoeff(), 1e-14);

  // What is within the limit stays as it is.
  Vector<double> small = 0.5 * rotation;
  LimitRotation(mesh, 0.75, small);
  EXPECT_EQ(small, Vector<double>(0.5 * rotation));
}

// 2 pi times the Euler characteristic of a closed surface; at a corner of a cube a quarter turn.
TEST(TrivialConnection, AngleDefectsSumToTheEulerCharacteristic)
{
  const std::vector<std::pair<Surface, double>> surfaces{ { IrregularSphere(2, 3), 2.0 },
    { IrregularTorus(12, 8, 4), 0.0 }, { DoubleTorus(1), -2.0 }, { IrregularPlane(6, 5, 3), 0.0 } };
  for (const auto& [shape, characteristic] : surfaces)
  {
    const FramedMesh surface(shape.Mesh());
    const auto& [mesh, faces, vertices] = surface;
    const Vector<double> defects = AngleDefects(mesh, Corners(mesh, SideDirections(mesh, faces), faces, vertices));
    EXPECT_NEAR(defects.sum(), 2.0 * Pi * characteristic, 1e-11);
  }
}

// Five edges cannot share more than five times the limit; what is impossible there leaves the others alone.
TEST(TrivialConnection, RotationThatCannotBeLimitedStaysAtItsPoint)
{
  const TriangleMesh mesh = Icosphere(2).Mesh();
  constexpr int Spike = 0; // of the icosahedron
  Vector<double> rotation = Vector<double>::Zero(mesh.NumberOfEdges());
  std::vector<char> isAtSpike(mesh.NumberOfEdges(), 0);
  mesh.VisitFan(Spike,
    [&](int h)
    {
      const int edge = mesh.EdgeOf(h);
      rotation[edge] = mesh.HalfedgeOf(edge) == h ? 0.8 : -0.8;
      isAtSpike[edge] = 1;
    });
  const Vector<double> before = rotation;
  LimitRotation(mesh, 0.75, rotation);
  EXPECT_EQ(rotation, before);

  // Beside it another edge, which can be limited.
  const int beside = mesh.EdgeOf(TriangleMesh::Next(mesh.OutgoingHalfedge(Spike)));
  rotation[beside] = 1.0;
  LimitRotation(mesh, 0.75, rotation);
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    EXPECT_TRUE(isAtSpike[edge] || std::abs(rotation[edge]) <= 0.75 * (1.0 + 1e-11)) << edge;
  }
}
