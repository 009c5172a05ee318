#include "Solvers/LeastSquares/BlockKernel.h"

#include "GridProblem.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <vector>

using namespace dmg;

namespace
{

constexpr int Lanes = LanesOf<FloatPack>;

/// Lower triangles by rows, lane by lane.
std::vector<float> LowerTriangles(const std::vector<Eigen::MatrixXf>& matrices)
{
  std::vector<float> triangles;
  for (int i = 0; i < matrices[0].rows(); ++i)
  {
    for (int j = 0; j <= i; ++j)
    {
      for (const Eigen::MatrixXf& A : matrices)
      {
        triangles.push_back(A(i, j));
      }
    }
  }
  return triangles;
}

Eigen::MatrixXf Symmetric(int size)
{
  const Eigen::MatrixXf A = Eigen::MatrixXf::Random(size, size);
  return A + A.transpose();
}

/// An unknown in two rows, and one in the second of them, which is not inside of the block.
BlockPattern TwoUnknowns()
{
  BlockPattern pattern;
  pattern.InnerRows = 1;
  pattern.Offsets = { 0, 2, 3 };
  pattern.RowOf = { 0, 1, 1 };
  pattern.RowOffsets = { 0, 1, 3 };
  pattern.EntryAt = { 0, 1, 2 };
  pattern.UnknownAt = { 0, 0, 1 };
  return pattern;
}

/// Reads and writes are those of the places by slots: i * Lanes + lane, unknowns and then rows.
template <class Pack, class Places>
void ExpectPlaces(const Places& places, const std::vector<int>& slots)
{
  constexpr int lanes = LanesOf<Pack>;
  std::vector<float> x(64);
  for (int i = 0; i < 64; ++i)
  {
    x[i] = static_cast<float>(i);
  }
  const auto check = [&](int first, const auto& read, const auto& write)
  {
    std::vector<float> lanesOfPack(lanes);
    StorePack(read(), lanesOfPack.data());
    std::vector<float> expected = x;
    for (int lane = 0; lane < lanes; ++lane)
    {
      EXPECT_EQ(lanesOfPack[lane], x[slots[first + lane]]);
      expected[slots[first + lane]] *= -2.0f;
    }
    write(read() * -2.0f);
    EXPECT_EQ(x, expected);
  };
  for (const int i : { 0, 1 })
  {
    check(
      i * lanes, [&] { return places.UnknownOf(x.data(), i); },
      [&](Pack pack) { places.SetUnknown(pack, x.data(), i); });
    check(
      (2 + i) * lanes, [&] { return places.RowOf(x.data(), i); }, [&](Pack pack) { places.SetRow(pack, x.data(), i); });
  }
}

}

TEST(TestBlockKernel, ProductsWithInverses)
{
  for (int size = 1; size <= 20; ++size)
  {
    const std::vector<Eigen::MatrixXf> matrices(Lanes, Symmetric(size));
    const Eigen::MatrixXf x = Eigen::MatrixXf::Random(Lanes, size);
    std::vector<float> y(size, -1.0f);
    const std::vector<float> single = LowerTriangles({ matrices[0] });
    const Eigen::VectorXf first = x.row(0).transpose();
    MultiplySymmetric(single.data(), size, first.data(), y.data(), single.data());
    const Eigen::VectorXf expected = matrices[0] * first;
    EXPECT_LE((Eigen::Map<Eigen::VectorXf>(y.data(), size) - expected).norm(), 1e-5f * size);
  }
}

TEST(TestBlockKernel, ProductsWithInversesInLanes)
{
  for (const int size : { 1, 2, 3, 7, 12 })
  {
    std::vector<Eigen::MatrixXf> matrices;
    for (int lane = 0; lane < Lanes; ++lane)
    {
      matrices.push_back(Symmetric(size));
    }
    const std::vector<float> triangles = LowerTriangles(matrices);
    const Eigen::MatrixXf x = Eigen::MatrixXf::Random(Lanes, size); // lanes side by side
    std::vector<FloatPack> packs(size), products(size);
    for (int i = 0; i < size; ++i)
    {
      packs[i] = LoadPack<FloatPack>(x.data() + i * Lanes);
    }
    MultiplySymmetric(triangles.data(), size, packs.data(), products.data(), triangles.data());
    for (int lane = 0; lane < Lanes; ++lane)
    {
      const Eigen::VectorXf expected = matrices[lane] * x.row(lane).transpose();
      for (int i = 0; i < size; ++i)
      {
        EXPECT_NEAR(products[i][lane], expected[i], 1e-5f * size);
      }
    }
  }
}

TEST(TestBlockKernel, PlacesAnywhere)
{
  const BlockPattern pattern = TwoUnknowns();
  const std::vector<int> ofOne = { 9, 4, 30, 2 };
  const PlacesAnywhere<float> one(pattern, ofOne.data());
  EXPECT_EQ(one.Size(), 4);
  ExpectPlaces<float>(one, ofOne);
  const std::vector<int> ofFour = { 9, 4, 30, 2, 1, 0, 5, 8, 60, 61, 17, 18, 40, 33, 32, 31 };
  const PlacesAnywhere<FloatPack> four(pattern, ofFour.data());
  EXPECT_EQ(four.Size(), 16);
  ExpectPlaces<FloatPack>(four, ofFour);
}

TEST(TestBlockKernel, PlacesInOrder)
{
  // Unknowns from 20 on; the lanes of the inner row from 40 on; those of the other row anywhere.
  const BlockPattern pattern = TwoUnknowns();
  const std::vector<int> rows = { 40, 9, 4, 30, 2 };
  const PlacesInOrder places(pattern, rows.data(), 20);
  EXPECT_EQ(places.Size(), 5);
  ExpectPlaces<FloatPack>(places, { 20, 21, 22, 23, 24, 25, 26, 27, 40, 41, 42, 43, 9, 4, 30, 2 });
}
