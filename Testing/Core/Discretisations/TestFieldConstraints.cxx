#include "Discretisations/Constraints/FieldConstraints.h"

#include "Support/ComplexPairs.h"
#include "Support/Errors.h"
#include "Support/Identities.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace dmg;
using namespace dmg::test;

class AlignmentConstraints : public ::testing::Test
{
protected:
  const TriangleMesh Mesh = IrregularSphere(1, 1).Mesh();
  const TangentFrames Frames = FaceFrames(this->Mesh);

  Vector3 Direction(int face, double angle, double length = 1.0) const
  {
    return this->Frames.ToVector(face, std::polar(length, angle));
  }
};

TEST_F(AlignmentConstraints, AreSortedPowersOfTheTangentialParts)
{
  for (int N = 1; N <= 8; ++N)
  {
    const Vector3 normal = this->Frames.Normal(9);
    const FieldConstraints constraints = MakePowerConstraints(this->Mesh, this->Frames, N,
      { { 20, this->Direction(20, 0.3, 2.5), 3.0 }, { 9, this->Direction(9, -1.1, 0.5) + 4.0 * normal, 1.5 } });
    EXPECT_EQ(constraints.Elements, (std::vector<int>{ 9, 20 }));
    EXPECT_EQ(constraints.Weights, (std::vector<double>{ 1.5, 3.0 }));
    ASSERT_EQ(constraints.Values.size(), 4);
    // The length is kept, the angle is multiplied.
    EXPECT_LT(std::abs(AsComplex(constraints.Values)[0] - std::polar(0.5, -1.1 * N)), 50 * MachinePrecision);
    EXPECT_LT(std::abs(AsComplex(constraints.Values)[1] - std::polar(2.5, 0.3 * N)), 50 * MachinePrecision);
  }
}

TEST_F(AlignmentConstraints, DirectionsThatAreEqualForNDirectionFieldsAgree)
{
  for (int N = 1; N <= 8; ++N)
  {
    std::vector<Constraint> directions;
    for (int k = 0; k < N; ++k)
    {
      directions.push_back({ 4, this->Direction(4, 0.2 + 2.0 * Pi * k / N), 1.0 + k });
    }
    const FieldConstraints constraints = MakePowerConstraints(this->Mesh, this->Frames, N, directions);
    ASSERT_EQ(constraints.Values.size(), 2);
    EXPECT_LT(std::abs(AsComplex(constraints.Values)[0] - std::polar(1.0, 0.2 * N)), 50 * MachinePrecision);
    EXPECT_DOUBLE_EQ(constraints.Weights[0], 0.5 * N * (N + 1));
  }
}

TEST_F(AlignmentConstraints, DirectionsOnOneFaceAreAveragedByWeight)
{
  const FieldConstraints constraints = MakePowerConstraints(
    this->Mesh, this->Frames, 1, { { 7, this->Direction(7, 0.0), 3.0 }, { 7, this->Direction(7, 0.5 * Pi), 1.0 } });
  EXPECT_LT(std::abs(AsComplex(constraints.Values)[0] - Complex(0.75, 0.25)), 10 * MachinePrecision);
}

// Opposite vectors mean nothing to a field of one direction, and the same to one of two; quarter turns likewise for two and four.
TEST_F(AlignmentConstraints, DirectionsThatCancelAreLeftOut)
{
  for (const auto& [N, cancelling] : { std::pair(1, 2), std::pair(2, 6), std::pair(4, -1) })
  {
    std::vector<Constraint> directions = { { 6, this->Direction(6, 0.3), 2.0 }, { 2, this->Direction(2, 0.1), 0.5 },
      { 4, this->Direction(4, 1.0), 3.0 }, { 2, -this->Direction(2, 0.1), 0.5 },
      { 6, this->Direction(6, 0.3 + 0.5 * Pi), 2.0 }, { 4, -this->Direction(4, 1.0), 1.0 } };
    std::vector<Constraint> expected;
    for (const Constraint& direction : directions)
    {
      if (direction.Element != cancelling)
      {
        expected.push_back(direction);
      }
    }
    const auto faces = LeaveOutCancelling(directions, this->Frames, N);
    EXPECT_EQ(faces, cancelling < 0 ? std::vector<int>() : std::vector<int>{ cancelling });
    ASSERT_EQ(directions.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      EXPECT_EQ(directions[i].Element, expected[i].Element);
      EXPECT_EQ(directions[i].Direction, expected[i].Direction);
    }
  }
}

TEST_F(AlignmentConstraints, NothingPrescribedIsEmpty)
{
  const FieldConstraints constraints = MakePowerConstraints(this->Mesh, this->Frames, 4, {});
  EXPECT_TRUE(constraints.Elements.empty());
  EXPECT_EQ(constraints.Values.size(), 0);
}

TEST_F(AlignmentConstraints, RefuseWhatIsNoDirection)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const Vector3 normal = this->Frames.Normal(5);
  const Vector3 good = this->Direction(5, 0.0);
  ElementNames names;
  for (int f = 0; f < this->Mesh.NumberOfFaces(); ++f)
  {
    names.Faces.push_back(1000 + f);
  }
  const struct
  {
    Constraint Bad;
    const char* Word;
  } cases[] = {
    { { 5, Vector3(nan, 0.0, 0.0), 1.0 }, "not finite" },
    { { 5, Vector3(0.0, infinity, 0.0), 1.0 }, "not finite" },
    { { 5, Vector3::Zero(), 1.0 }, "zero" },
    { { 5, 3.0 * normal, 1.0 }, "perpendicular" },
    { { 5, good, 0.0 }, "weight" },
    { { 5, good, -1.0 }, "weight" },
    { { 5, good, nan }, "weight" },
    { { 5, good, infinity }, "weight" },
  };
  for (const auto& example : cases)
  {
    try
    {
      MakePowerConstraints(this->Mesh, this->Frames, 2, { example.Bad }, names);
      ADD_FAILURE() << "accepted; expected \"" << example.Word << '"';
    }
    catch (const InvalidInput& error)
    {
      const std::string message = error.what();
      EXPECT_NE(message.find("cell 1005"), std::string::npos) << message;
      EXPECT_NE(message.find(example.Word), std::string::npos) << message;
      EXPECT_NE(message.find("taking it from Constraints"), std::string::npos) << message; // the remedy
    }
  }
  for (int face : { -1, this->Mesh.NumberOfFaces() })
  {
    EXPECT_THROW(MakePowerConstraints(this->Mesh, this->Frames, 2, { { face, good, 1.0 } }), InvalidInput);
  }
}

}
