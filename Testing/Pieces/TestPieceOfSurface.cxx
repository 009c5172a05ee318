#include "Pieces/Surface/PieceComponents.h"
#include "Pieces/Surface/PieceOfSurface.h"

#include "Partitions.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <vector>

using namespace dmg;

namespace
{

struct Named
{
  std::string Name;
  test::Surface Surface;
};

std::vector<Named> Surfaces()
{
  return {
    { "sphere", test::IrregularSphere(3, 3) },
    { "torus", test::IrregularTorus(24, 12, 4) },
    { "annulus", test::Annulus(30, 6) },
    { "two", test::Union(test::Icosphere(2), test::Disk(6), Vector3(4.0, 0.0, 0.0)) },
  };
}

/// Calls check(surface, its mesh, cut, piece) for all partitions, besides one where each triangle has a rank of its own.
template <class Check>
void ForAll(const Check& check)
{
  const Ranks ranks(MPI_COMM_WORLD);
  std::vector<test::NamedPartition> partitions = test::Partitions();
  partitions.push_back({ "no two neighbours",
    [](const test::Surface& surface, int numberOfRanks)
    {
      std::vector<int> ofTriangles;
      for (int triangle = 0; triangle < surface.F.rows(); ++triangle)
      {
        ofTriangles.push_back((triangle * 7 + triangle / 3) % numberOfRanks);
      }
      return ofTriangles;
    } });
  for (const Named& named : Surfaces())
  {
    const TriangleMesh mesh = named.Surface.Mesh();
    for (const test::NamedPartition& partition : partitions)
    {
      SCOPED_TRACE(named.Name + ", " + partition.Name);
      const test::CutPiece cut =
        test::CutOut(named.Surface, partition.RanksOfTriangles(named.Surface, ranks.Size()), ranks.Rank());
      const PieceOfSurface piece(ranks, cut.Piece, {}, SerialContext());
      check(mesh, cut, piece);
    }
  }
}

}

TEST(PieceOfSurface, OwnedVerticesAreThoseOfTheSurface)
{
  ForAll(
    [](const TriangleMesh& mesh, const test::CutPiece& cut, const PieceOfSurface& piece)
    {
      EXPECT_EQ(piece.GlobalNumberOfVertices(), mesh.NumberOfVertices());
      EXPECT_EQ(piece.NumberOfOwnFaces(), static_cast<int>(cut.Triangles.size()));
      // The global number of each vertex of the whole surface is the same wherever it is seen.
      std::vector<long long> numbers(mesh.NumberOfVertices(), -1);
      for (std::size_t i = 0; i < cut.Points.size(); ++i)
      {
        numbers[cut.Points[i]] = piece.GlobalNumbers()[piece.VerticesOfPoints()[i]];
      }
      const Received<long long> all = piece.Everyone().GatherToAll(numbers);
      std::set<long long> different;
      for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
      {
        std::set<long long> here;
        for (std::size_t k = vertex; k < all.Items.size(); k += mesh.NumberOfVertices())
        {
          here.insert(all.Items[k]);
        }
        here.erase(-1);
        EXPECT_EQ(here.size(), 1u);
        different.insert(here.begin(), here.end());
      }
      EXPECT_EQ(static_cast<int>(different.size()), mesh.NumberOfVertices());
    });
}

TEST(PieceOfSurface, FansOfOwnTrianglesAreComplete)
{
  ForAll(
    [](const TriangleMesh& mesh, const test::CutPiece& cut, const PieceOfSurface& piece)
    {
      for (std::size_t i = 0; i < cut.Points.size(); ++i)
      {
        const auto sizeOf = [](const TriangleMesh& of, int vertex)
        {
          int faces = 0;
          of.VisitFan(vertex, [&faces](int) { ++faces; });
          return faces;
        };
        const int vertex = piece.VerticesOfPoints()[i];
        EXPECT_EQ(sizeOf(piece.Surface().Mesh, vertex), sizeOf(mesh, cut.Points[i]));
        EXPECT_EQ(piece.Surface().Mesh.IsBoundaryVertex(vertex), mesh.IsBoundaryVertex(cut.Points[i]));
        EXPECT_EQ(piece.Surface().Mesh.Position(vertex), mesh.Position(cut.Points[i]));
      }
    });
}

TEST(PieceOfSurface, RanksAgreeOnFramesAndConnection)
{
  ForAll(
    [](const TriangleMesh&, const test::CutPiece&, const PieceOfSurface& piece)
    {
      constexpr double Rounding = 1e-13;
      struct Axis
      {
        double X[3];
      };
      std::vector<Axis> axes;
      for (int i = 0; i < piece.NumberOfOwned(); ++i)
      {
        const auto x = piece.Surface().Vertices.X.row(piece.FirstOwned() + i);
        axes.push_back({ { x[0], x[1], x[2] } });
      }
      axes = piece.WithGhosts<Axis>(axes);
      for (const int vertex : piece.VerticesOfPoints())
      {
        const auto x = piece.Surface().Vertices.X.row(vertex);
        EXPECT_LE((x - Eigen::Map<const Eigen::RowVector3d>(axes[vertex].X)).norm(), Rounding);
      }
      // Transport there and back is none, across seams as well.
      for (int h = 0; h < 3 * piece.Surface().Mesh.NumberOfFaces(); ++h)
      {
        if (const int twin = piece.Surface().Mesh.Twin(h); twin >= 0)
        {
          const double sum = piece.Connection().Transport(h) + piece.Connection().Transport(twin);
          EXPECT_LE(std::abs(std::polar(1.0, sum) - 1.0), Rounding);
        }
      }
    });
}

TEST(PieceOfSurface, ComponentsAreThoseOfTheSurface)
{
  ForAll(
    [](const TriangleMesh& mesh, const test::CutPiece&, const PieceOfSurface& piece)
    {
      const PieceComponents components = ComponentsOfPieces(piece);
      const Received<int> all = piece.Everyone().GatherToAll(components.OfOwned);
      const std::vector<int> ofFaces = FaceComponents(mesh);
      EXPECT_EQ(
        std::set<int>(all.Items.begin(), all.Items.end()).size(), std::set<int>(ofFaces.begin(), ofFaces.end()).size());
    });
}

TEST(PieceOfSurface, PinchedPointsArePartedAndSlitsAreClosed)
{
  // Two tetrahedra that share a corner are two components, whoever has them.
  const test::Surface pinched = test::PinchedTetrahedra();
  const Ranks ranks(MPI_COMM_WORLD);
  const test::CutPiece cut =
    test::CutOut(pinched, test::Partitions()[0].RanksOfTriangles(pinched, ranks.Size()), ranks.Rank());
  const PieceOfSurface piece(ranks, cut.Piece, {}, SerialContext());
  EXPECT_EQ(piece.GlobalNumberOfVertices(), 8);

  // A rank whose points are not joined: the seam of the capsule closes by place. Its sides without length stay open.
  test::Surface soup = test::Icosphere(2);
  test::Surface apart{ Points(3 * soup.F.rows(), 3), Triangles(soup.F.rows(), 3) };
  for (Eigen::Index h = 0; h < soup.F.size(); ++h)
  {
    apart.V.row(h) = soup.V.row(soup.F.data()[h]);
    apart.F.data()[h] = static_cast<int>(h);
  }
  const test::CutPiece part =
    test::CutOut(apart, test::Partitions()[1].RanksOfTriangles(apart, ranks.Size()), ranks.Rank());
  const PieceOfSurface joined(ranks, part.Piece, {}, SerialContext());
  EXPECT_EQ(joined.GlobalNumberOfVertices(), soup.V.rows());
}
