#include "Discretisations/Levels/SmoothingBlocks.h"

#include "Mesh/FaceFans.h"
#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

using namespace dmg;

namespace
{

std::vector<std::set<int>> SetsOf(const UnknownBlocks& blocks)
{
  std::vector<std::set<int>> sets;
  for (int k = 0; k < blocks.Size(); ++k)
  {
    sets.emplace_back(blocks.Unknowns.begin() + blocks.Offsets[k], blocks.Unknowns.begin() + blocks.Offsets[k + 1]);
    EXPECT_EQ(static_cast<int>(sets.back().size()), blocks.Offsets[k + 1] - blocks.Offsets[k])
      << "block " << k << " holds an unknown twice";
  }
  return sets;
}

std::set<int> Union(const std::vector<std::set<int>>& sets)
{
  std::set<int> all;
  for (const std::set<int>& set : sets)
  {
    all.insert(set.begin(), set.end());
  }
  return all;
}

/// Each unknown is in one of them.
void ExpectParts(const std::vector<std::set<int>>& sets, int unknowns)
{
  std::size_t sum = 0;
  for (const std::set<int>& set : sets)
  {
    sum += set.size();
  }
  EXPECT_EQ(static_cast<int>(sum), unknowns);
  EXPECT_EQ(static_cast<int>(Union(sets).size()), unknowns);
}

std::set<int> SidesOf(const TriangleMesh& mesh, int face)
{
  return { mesh.EdgeOf(3 * face), mesh.EdgeOf(3 * face + 1), mesh.EdgeOf(3 * face + 2) };
}

std::vector<int> NeighboursOf(const TriangleMesh& mesh, int face)
{
  std::vector<int> neighbours;
  mesh.VisitNeighbours(face, [&neighbours](int neighbour) { neighbours.push_back(neighbour); });
  return neighbours;
}

/// A strip of columns one wide; one of them is thin.
TriangleMesh StripWithThinColumn(int columns, int thin, double width)
{
  std::vector<double> widths(columns, 1.0);
  widths[thin] = width;
  return test::Strip(widths).Mesh();
}

}

TEST(SmoothingBlocks, AreSidesOfFacesWhereFacesAreEven)
{
  // Every second face of a regular torus has all sides between them.
  const TriangleMesh torus = test::Torus(12, 9, 1.0, 0.5).Mesh();
  EXPECT_EQ(BlocksOfOneForms(torus).Size(), torus.NumberOfFaces() / 2);

  const TriangleMesh mesh = test::Icosphere(2).Mesh();
  const std::vector<std::set<int>> blocks = SetsOf(BlocksOfOneForms(mesh));
  ExpectParts(blocks, mesh.NumberOfEdges());
  for (const std::set<int>& block : blocks)
  {
    bool isOfOneFace = false;
    for (int face = 0; face < mesh.NumberOfFaces(); ++face)
    {
      const std::set<int> sides = SidesOf(mesh, face);
      isOfOneFace |= std::includes(sides.begin(), sides.end(), block.begin(), block.end());
    }
    EXPECT_TRUE(isOfOneFace);
  }
}

TEST(SmoothingBlocks, AreFansWhereFacesAreEven)
{
  const TriangleMesh mesh = test::Icosphere(2).Mesh();
  const std::vector<std::set<int>> blocks = SetsOf(BlocksOfFaceFields(mesh));
  ExpectParts(blocks, 2 * mesh.NumberOfFaces());
  const FaceFans fans = PackFans(mesh, 16);
  ASSERT_EQ(static_cast<int>(blocks.size()), fans.Size());
  for (int fan = 0; fan < fans.Size(); ++fan)
  {
    for (int k = fans.Offsets[fan]; k < fans.Offsets[fan + 1]; ++k)
    {
      EXPECT_EQ(blocks[fan].count(2 * fans.Faces[k]), 1U);
      EXPECT_EQ(blocks[fan].count(2 * fans.Faces[k] + 1), 1U);
    }
  }
}

TEST(SmoothingBlocks, UnevenFacesAreTogetherWithTwoRingsAroundThem)
{
  // Faces 8 and 9 are thin; two rings are the two faces on either side.
  const TriangleMesh mesh = StripWithThinColumn(12, 4, 0.05);
  const std::vector<std::set<int>> forms = SetsOf(BlocksOfOneForms(mesh));
  std::set<int> sides;
  std::set<int> components;
  for (int face = 6; face <= 11; ++face)
  {
    const std::set<int> more = SidesOf(mesh, face);
    sides.insert(more.begin(), more.end());
    components.insert({ 2 * face, 2 * face + 1 });
  }
  EXPECT_EQ(forms.back(), sides);
  ExpectParts({ forms.begin(), forms.end() - 1 }, mesh.NumberOfEdges());
  const std::vector<std::set<int>> fields = SetsOf(BlocksOfFaceFields(mesh));
  EXPECT_EQ(fields.back(), components);
  ExpectParts({ fields.begin(), fields.end() - 1 }, 2 * mesh.NumberOfFaces());
}

TEST(SmoothingBlocks, ManyUnevenFacesAreInSeveralPatches)
{
  // Squeezed, every face is uneven.
  test::Surface surface = test::PlaneGrid(30, 24);
  surface.V.col(1) *= 0.15;
  const TriangleMesh mesh = surface.Mesh();
  const std::vector<std::set<int>> forms = SetsOf(BlocksOfOneForms(mesh));
  EXPECT_EQ(static_cast<int>(Union(forms).size()), mesh.NumberOfEdges());
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    // With all its neighbours, or with the rim of a full patch.
    const std::set<int> own = SidesOf(mesh, face);
    EXPECT_TRUE(std::any_of(forms.begin(), forms.end(),
      [&own](const std::set<int>& patch)
      { return patch.size() > own.size() && std::includes(patch.begin(), patch.end(), own.begin(), own.end()); }))
      << "face " << face << " is in no patch";
  }
  surface.V.col(1) *= 0.5;
  const TriangleMesh thinner = surface.Mesh();
  const std::vector<std::set<int>> fields = SetsOf(BlocksOfFaceFields(thinner));
  EXPECT_GT(static_cast<int>(fields.size()), PackFans(thinner, UnknownBlocks::LargestBlock / 4).Size());
  EXPECT_EQ(static_cast<int>(Union(fields).size()), 2 * mesh.NumberOfFaces());
  for (const auto* blocks : { &forms, &fields })
  {
    for (const std::set<int>& block : *blocks)
    {
      EXPECT_LE(static_cast<int>(block.size()), UnknownBlocks::LargestBlock);
    }
  }
}

TEST(SmoothingBlocks, PatchesAreConnected)
{
  test::Surface surface = test::IrregularPlane(20, 16, 4);
  surface.V.col(1) *= 0.1;
  const TriangleMesh mesh = surface.Mesh();
  const std::vector<std::set<int>> blocks = SetsOf(BlocksOfFaceFields(mesh));
  ASSERT_GT(static_cast<int>(blocks.size()), PackFans(mesh, UnknownBlocks::LargestBlock / 4).Size());
  for (std::size_t k = 0; k < blocks.size(); ++k) // fans, too
  {
    std::set<int> reached = { *blocks[k].begin() / 2 };
    std::vector<int> stack(reached.begin(), reached.end());
    while (!stack.empty())
    {
      const int face = stack.back();
      stack.pop_back();
      for (const int neighbour : NeighboursOf(mesh, face))
      {
        if (blocks[k].count(2 * neighbour) > 0 && reached.insert(neighbour).second)
        {
          stack.push_back(neighbour);
        }
      }
    }
    EXPECT_EQ(2 * reached.size(), blocks[k].size());
  }
}

TEST(SmoothingBlocks, FacesAreUnevenByTheAreaOverThatOfAnEquilateralTriangle)
{
  // Legs 1 and h, hypotenuse sqrt(1 + h^2): the area is a tenth of the equilateral one at h = 0.0872.
  for (const double h : { 0.086, 0.089 })
  {
    const double fraction = 0.5 * h / (std::sqrt(3.0) / 4.0 * (1.0 + h * h));
    const TriangleMesh mesh = StripWithThinColumn(12, 4, h);
    const int patches = BlocksOfFaceFields(mesh).Size() - PackFans(mesh, UnknownBlocks::LargestBlock / 4).Size();
    EXPECT_EQ(patches, fraction <= 0.1 ? 1 : 0) << h;
  }
}
