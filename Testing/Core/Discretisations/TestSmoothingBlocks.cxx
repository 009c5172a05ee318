#include "Discretisations/SmoothingBlocks.h"

#include "Mesh/FaceFans.h"
#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

#include <algorithm>
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
    sets.emplace_back(blocks.Unknowns.begin() + blocks.Offsets[k],
      blocks.Unknowns.begin() + blocks.Offsets[k + 1]);
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

TEST(SmoothingBlocks, SidesOfEvenFaces)
{
  // Every second face of a regular torus has all sides between them.
  const TriangleMesh torus = test::Torus(12, 9, 1.0, 0.5).Mesh();
  EXPECT_EQ(BlocksOfOneForms(torus).Small.Size(), torus.NumberOfFaces() / 2);

  const TriangleMesh mesh = test::Icosphere(2).Mesh();
  const std::vector<std::set<int>> blocks = SetsOf(BlocksOfOneForms(mesh).Small);
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

TEST(SmoothingBlocks, FansOfEvenFaces)
{
  const TriangleMesh mesh = test::Icosphere(2).Mesh();
  const std::vector<std::set<int>> blocks = SetsOf(BlocksOfFaceFields(mesh).Small);
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
  const std::vector<std::set<int>> forms = SetsOf(BlocksOfOneForms(mesh).Small);
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
  const std::vector<std::set<int>> fields = SetsOf(BlocksOfFaceFields(mesh).Small);
  EXPECT_EQ(fields.back(), components);
  ExpectParts({ fields.begin(), fields.end() - 1 }, 2 * mesh.NumberOfFaces());
}

TEST(SmoothingBlocks, ManyUnevenFacesAreInSeveralPatches)
{
  // Squeezed, every face is uneven, and none is a needle.
  test::Surface surface = test::PlaneGrid(30, 24);
  surface.V.col(1) *= 0.15;
  const TriangleMesh mesh = surface.Mesh();
  ASSERT_EQ(BlocksOfOneForms(mesh).Subdomains.Size(), 0);
  const std::vector<std::set<int>> forms = SetsOf(BlocksOfOneForms(mesh).Small);
  EXPECT_EQ(static_cast<int>(Union(forms).size()), mesh.NumberOfEdges());
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    // With all its neighbours, or with the rim of a full patch.
    const std::set<int> own = SidesOf(mesh, face);
    EXPECT_TRUE(std::any_of(forms.begin(), forms.end(),
      [&own](const std::set<int>& patch)
      {
        return patch.size() > own.size() &&
          std::includes(patch.begin(), patch.end(), own.begin(), own.end());
      }))
      << "face " << face << " is in no patch";
  }
  surface.V.col(1) *= 0.5;
  const TriangleMesh thinner = surface.Mesh();
  ASSERT_EQ(BlocksOfFaceFields(thinner).Subdomains.Size(), 0);
  const std::vector<std::set<int>> fields = SetsOf(BlocksOfFaceFields(thinner).Small);
  EXPECT_GT(static_cast<int>(fields.size()), PackFans(thinner, SchwarzBlocks::LargestBlock / 4).Size());
  EXPECT_EQ(static_cast<int>(Union(fields).size()), 2 * mesh.NumberOfFaces());
  for (const auto* blocks : { &forms, &fields })
  {
    for (const std::set<int>& block : *blocks)
    {
      EXPECT_LE(static_cast<int>(block.size()), SchwarzBlocks::LargestBlock);
    }
  }
}

TEST(SmoothingBlocks, PatchesAreConnected)
{
  test::Surface surface = test::IrregularPlane(20, 16, 4);
  surface.V.col(1) *= 0.1;
  const TriangleMesh mesh = surface.Mesh();
  const std::vector<std::set<int>> blocks = SetsOf(BlocksOfFaceFields(mesh).Small);
  ASSERT_GT(static_cast<int>(blocks.size()), PackFans(mesh, SchwarzBlocks::LargestBlock / 4).Size());
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

TEST(SmoothingBlocks, FewNeedlesAreInNoSubdomain)
{
  for (const TriangleMesh& mesh :
    { test::IrregularSphere(3, 2).Mesh(), StripWithThinColumn(12, 4, 0.01) })
  {
    EXPECT_EQ(BlocksOfOneForms(mesh).Subdomains.Size(), 0);
    EXPECT_EQ(BlocksOfFaceFields(mesh).Subdomains.Size(), 0);
  }
}

TEST(SmoothingBlocks, ManyNeedlesAreInSubdomainsAndNotInPatches)
{
  // More faces than a piece takes.
  test::Surface surface = test::IrregularPlane(60, 48, 4);
  surface.V.col(1) *= 0.005;
  const TriangleMesh mesh = surface.Mesh();
  const auto componentsOf = [](int face) { return std::set<int>{ 2 * face, 2 * face + 1 }; };
  const auto expect = [&mesh](const SmoothingBlocks& blocks, int unknowns, const auto& unknownsOf) {
    ExpectParts(SetsOf(blocks.Small), unknowns);
    ASSERT_GE(blocks.Subdomains.Size(), 2);
    const std::vector<std::set<int>> sets = SetsOf(blocks.Subdomains);
    EXPECT_EQ(static_cast<int>(Union(sets).size()), unknowns);
    EXPECT_GT(static_cast<int>(blocks.Subdomains.Unknowns.size()), unknowns); // they overlap
    for (int face = 0; face < mesh.NumberOfFaces(); ++face)
    {
      // With all that shares an equation with its unknowns.
      std::set<int> near = unknownsOf(face);
      for (const int neighbour : NeighboursOf(mesh, face))
      {
        near.merge(unknownsOf(neighbour));
      }
      EXPECT_TRUE(std::any_of(sets.begin(), sets.end(), [&near](const std::set<int>& subdomain)
        { return std::includes(subdomain.begin(), subdomain.end(), near.begin(), near.end()); }))
        << "face " << face;
    }
  };
  expect(BlocksOfOneForms(mesh), mesh.NumberOfEdges(),
    [&mesh](int face) { return SidesOf(mesh, face); });
  expect(BlocksOfFaceFields(mesh), 2 * mesh.NumberOfFaces(), componentsOf);
}

TEST(SmoothingBlocks, CoarseFunctionsAreKeptOffNeedlesAndOneRingAroundThem)
{
  const TriangleMesh mesh = StripWithThinColumn(12, 4, 0.01);
  std::set<int> edges;
  std::set<int> components;
  for (int face = 2 * 4 - 1; face < 2 * 4 + 3; ++face)
  {
    edges.merge(SidesOf(mesh, face));
    components.insert({ 2 * face, 2 * face + 1 });
  }
  EXPECT_EQ(SetsOf(BlocksOfOneForms(mesh).Needles), std::vector<std::set<int>>{ edges });
  EXPECT_EQ(SetsOf(BlocksOfFaceFields(mesh).Needles), std::vector<std::set<int>>{ components });
  EXPECT_EQ(BlocksOfOneForms(test::IrregularSphere(3, 2).Mesh()).Needles.Size(), 0);
}

TEST(SmoothingBlocks, CoarseFunctionsRunIntoNeedlesWhereTheseAreTooMany)
{
  // Two thin columns, and then nothing but needles.
  std::vector<double> widths(12, 1.0);
  widths[4] = 0.01;
  widths.insert(widths.end(), 400, 0.01);
  const TriangleMesh mesh = test::Strip(widths).Mesh();
  for (const UnknownBlocks& needles : { BlocksOfOneForms(mesh).Needles, BlocksOfFaceFields(mesh).Needles })
  {
    ASSERT_EQ(needles.Size(), 1);
    EXPECT_LT(needles.Unknowns.size(), 12U);
  }
}

TEST(SmoothingBlocks, RegionsOfPowersHoldNeedlesAndThreeRingsAroundThem)
{
  const auto strip = [](int thin) {
    std::vector<double> widths(12, 1.0);
    std::fill_n(widths.begin() + 4, thin, 0.01);
    return test::Strip(widths).Mesh();
  };
  EXPECT_EQ(RegionsOfPowerFields(strip(3)).Size(), 0); // six needles
  std::set<int> expected;
  for (int face = 2 * 4 - 3; face < 2 * 8 + 3; ++face)
  {
    expected.insert(face);
  }
  EXPECT_EQ(SetsOf(RegionsOfPowerFields(strip(4))), std::vector<std::set<int>>{ expected });
  // More than a factor should take.
  EXPECT_EQ(RegionsOfPowerFields(test::Strip(std::vector<double>(3000, 0.01)).Mesh()).Size(), 0);
}
