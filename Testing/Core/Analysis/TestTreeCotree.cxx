#include "Analysis/TreeCotree.h"

#include "Analysis/HarmonicForms.h"
#include "Operators/ExteriorCalculus.h"
#include "Support/AllIndices.h"
#include "Support/NamedSurfaces.h"
#include "Support/ReferenceOperators.h"

#include <Eigen/QR>
#include <gtest/gtest.h>

using namespace dmg;
using namespace dmg::test;

// Loops are the classes of closed forms that vanish on the boundary: as many as there are harmonic forms, and no combination is
// the gradient of a function that vanishes there.
TEST(TreeCotree, GeneratorsOverFacesAreClosedAndIndependentAndStayInside)
{
  for (const auto& [name, surface] : SmallSurfaces())
  {
    const TriangleMesh mesh = surface.Mesh();
    const TreeCotree trees = MakeTreeCotree(mesh, BoundaryAs::Vertex);
    const Eigen::MatrixXd loops(GeneratorsOverFaces(mesh, trees));
    ASSERT_EQ(loops.cols(), NumberOfGenerators(mesh)) << name;
    if (loops.cols() == 0)
    {
      continue;
    }
    EXPECT_EQ((D1(mesh) * loops).cwiseAbs().maxCoeff(), 0.0) << name;
    std::vector<int> inside;
    for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
    {
      if (!mesh.IsBoundaryVertex(vertex))
      {
        inside.push_back(vertex);
      }
    }
    for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
    {
      if (mesh.Twin(mesh.HalfedgeOf(edge)) < 0)
      {
        EXPECT_EQ(loops.row(edge).cwiseAbs().maxCoeff(), 0.0) << name << ", edge " << edge;
      }
    }
    const Eigen::MatrixXd gradients = Eigen::MatrixXd(D0(mesh))(All, inside);
    const auto rankOfGradients = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(gradients).rank();
    Eigen::MatrixXd both(mesh.NumberOfEdges(), gradients.cols() + loops.cols());
    both << gradients, loops;
    EXPECT_EQ(Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(both).rank(), rankOfGradients + loops.cols()) << name;
  }
}

// The parent is listed before its children, and is reached by crossing the side that is named.
TEST(TreeCotree, FacesFollowTheirParents)
{
  for (const auto& [name, surface] : SmallSurfaces())
  {
    const TriangleMesh mesh = surface.Mesh();
    for (const BoundaryAs boundary : { BoundaryAs::Face, BoundaryAs::Vertex })
    {
      const TreeCotree trees = MakeTreeCotree(mesh, boundary);
      std::vector<char> isListed(mesh.NumberOfFaces(), 0);
      for (const int face : trees.Faces)
      {
        const int h = trees.ParentHalfedges[face];
        EXPECT_FALSE(isListed[face]) << name;
        EXPECT_TRUE(h < 0 || TriangleMesh::FaceOf(h) == face) << name;
        EXPECT_TRUE(h < 0 || mesh.Twin(h) >= 0 || boundary == BoundaryAs::Face) << name;
        EXPECT_TRUE(h < 0 || mesh.Twin(h) < 0 || isListed[TriangleMesh::FaceOf(mesh.Twin(h))]) << name;
        isListed[face] = 1;
      }
      EXPECT_EQ(static_cast<int>(trees.Faces.size()), mesh.NumberOfFaces()) << name;
    }
  }
}
