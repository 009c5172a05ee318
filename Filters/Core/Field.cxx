#include "Field.h"

#include "Directions/FieldTopology.h"
#include "Directions/PowerFieldDirections.h"

namespace dmg
{

namespace
{

Points DirectionsInSpace(
  const TangentFrames& frames, const Vector<Complex>& first, int N, bool hasUnitLength, int direction)
{
  const DirectionVectors vectors(N, hasUnitLength, direction + 1);
  Points inSpace(first.size(), 3);
  for (int element = 0; element < first.size(); ++element)
  {
    vectors.VisitAt(frames, element, first[element],
      [&](int k, const Vector3& vector)
      {
        if (k == direction)
        {
          inSpace.row(element) = vector.transpose();
        }
      });
  }
  return inSpace;
}

/// Rotations along edges and indices of faces of a field at vertices.
void FindIndicesOfFaces(
  const TriangleMesh& mesh, const VertexConnection& connection, Field& field, const ExecutionContext& context)
{
  field.AreSingularitiesOnFaces = true;
  field.Rotation = RotationAlongEdges(mesh, connection, field.Powers.Vertices, field.N, context);
  field.Indices = IndicesOfFaces(mesh, connection, field.Rotation, field.N, context);
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    field.Rotation[edge] *=
      mesh.EdgeSign(mesh.HalfedgeOf(edge)); // on the boundary an edge may have the other halfedge alone
  }
}

/// Calls two functions, at the same time where there are threads.
template <class First, class Second>
void CallBoth(const ExecutionContext& context, const First& first, const Second& second)
{
  context.ParallelFor(0, 2, 1,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        i == 0 ? first() : second();
      }
    });
}

/// The indices of singularities: of faces where a connection carries directions between vertices, else of vertices.
void FindIndices(const TriangleMesh& mesh, const VertexConnection* connection, const Unfilled<Corner>& corners,
  const PrincipalMatching& matching, Field& field, const ExecutionContext& context)
{
  if (connection)
  {
    FindIndicesOfFaces(mesh, *connection, field, context);
    return;
  }
  field.Indices = SingularityIndices(mesh, corners, matching.Rotation, field.N, context);
}

/// The first direction of each face, and of each vertex near to those of its faces if the field is combed.
void ChooseFirstDirections(const TriangleMesh& mesh, const VertexConnection* connection,
  const Unfilled<Corner>& corners, const std::vector<int>& labels, Field& field, const ExecutionContext& context)
{
  field.OnFaces = FirstDirections(field.Powers.Faces, field.N, labels, context);
  const auto turnFromFace = [&](int h) { return connection ? connection->TurnFromFace(h) : corners[h].Turn; };
  field.AtVertices = field.IsCombed
    ? FirstDirectionsAtVertices(mesh, turnFromFace, field.OnFaces, field.Powers.Vertices, field.N, context)
    : FirstDirections(field.Powers.Vertices, field.N, {}, context);
}

}

Points Field::DirectionsOnFaces(const FramedMesh& surface, int k) const
{
  return DirectionsInSpace(surface.Faces, this->OnFaces, this->N, this->HasUnitLength, k);
}

Points Field::DirectionsAtVertices(const FramedMesh& surface, int k) const
{
  return DirectionsInSpace(surface.Vertices, this->AtVertices, this->N, this->HasUnitLength, k);
}

Field DirectionsOfField(const FramedMesh& surface, const Discretisation& discretisation, const Vector<double>& unknowns,
  bool combing, const Field* former, const ExecutionContext& context)
{
  const TriangleMesh& mesh = surface.Mesh;
  const int N = discretisation.DirectionsPerPoint();
  const VertexConnection* const connection = discretisation.ConnectionOfPowers(context);
  // A connection carries directions between faces and vertices by itself.
  Unfilled<Complex> sides;
  Unfilled<Corner> corners;
  if (!connection)
  {
    sides = SideDirections(mesh, surface.Faces, context);
    corners = Corners(mesh, sides, surface.Faces, surface.Vertices, context);
  }
  Field field;
  field.IsCombed = combing;
  field.N = N;
  field.Powers = discretisation.Powers(unknowns, corners, context);
  const Vector<Complex>& powers = field.Powers.Faces;
  context.Checkpoint(0.3);

  std::vector<int> labels;
  if (combing && former && former->IsCombed && former->N == N)
  {
    labels = LabelsNearTo(former->OnFaces, powers, N, context);
  }
  const bool growsTree = combing && labels.empty();
  PrincipalMatching matching;
  if (growsTree || !connection)
  {
    if (connection)
    {
      sides = SideDirections(mesh, surface.Faces, context);
    }
    matching = MatchDirections(mesh, sides, powers, N, context);
  }
  context.Checkpoint(0.6);

  const auto findIndices = [&] { FindIndices(mesh, connection, corners, matching, field, context); };
  if (growsTree)
  {
    // It grows in one thread; what does not need it goes on beside.
    CallBoth(
      context, [&] { labels = CombingLabels(mesh, powers, matching, N, context); }, findIndices);
  }
  else
  {
    findIndices();
  }
  if (!connection)
  {
    field.Rotation = std::move(matching.Rotation);
  }
  ChooseFirstDirections(mesh, connection, corners, labels, field, context);
  context.Checkpoint(1.0);
  return field;
}

}
