#include "Discretisations/Discretisation.h"

#include "Support/FieldProblem.h"
#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

using namespace dmg;
using namespace dmg::test;

// A vertex constrains what is around it: the faces, or for 1-forms the edges; beside faces, too.
TEST(Discretisation, TakesDirectionsAtVertices)
{
  const FramedMesh surface(IrregularSphere(2, 3).Mesh());
  const auto& [mesh, faces, vertices] = surface;
  const int vertex = 50;
  const Vector3 direction = 2.0 * vertices.X.row(vertex).transpose();
  std::vector<int> facesAround;
  std::vector<int> edgesAround;
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    if (mesh.Tail(h) == vertex)
    {
      facesAround.push_back(TriangleMesh::FaceOf(h));
      edgesAround.push_back(mesh.EdgeOf(h));
    }
  }
  std::sort(edgesAround.begin(), edgesAround.end());
  for (DiscretisationKind kind :
    { DiscretisationKind::PowerField, DiscretisationKind::FaceField, DiscretisationKind::OneForm })
  {
    FieldOptions options;
    options.Field.Kind = kind;
    const bool isOneForm = kind == DiscretisationKind::OneForm;
    const FieldConstraints alone = MakeFieldConstraints(surface, { {}, { { vertex, direction, 3.0 } } }, options);
    EXPECT_EQ(alone.Elements, isOneForm ? edgesAround : facesAround);
    EXPECT_EQ(alone.Weights, std::vector<double>(alone.Elements.size(), isOneForm ? 1.5 : 3.0)); // one end of two
    if (!isOneForm)
    {
      for (Eigen::Index b = 0; b < alone.Values.size(); b += 2)
      {
        EXPECT_NEAR(alone.Values.segment<2>(b).norm(), 2.0, 1e-14); // turned, not shortened
      }
    }
    const int other = facesAround.front() == 0 ? 1 : 0;
    const Constraint onFace = { other, faces.X.row(other).transpose(), 1.0 };
    const FieldConstraints both =
      MakeFieldConstraints(surface, { { onFace }, { { vertex, direction, 3.0 } } }, options);
    EXPECT_EQ(both.Elements.size(), alone.Elements.size() + (isOneForm ? 3 : 1));
  }
}
