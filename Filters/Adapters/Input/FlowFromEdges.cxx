#include "Adapters/Input/FlowFromEdges.h"

#include "Adapters/Data/CellChecks.h"
#include "Adapters/Input/GuideDataSets.h"
#include "Adapters/View/ChosenArrays.h"
#include "Flows/FlowOperators.h"
#include "Flows/FormOnPolygons.h"
#include "Support/Errors.h"
#include "Support/Hash.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointSet.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

namespace dmg
{
namespace
{

using FloatPoint = std::array<float, 3>;

struct HashOfPoint
{
  std::size_t operator()(const FloatPoint& point) const
  {
    std::uint64_t hash = 0;
    for (const float coordinate : point)
    {
      hash = MixHash(hash, std::hash<float>()(coordinate));
    }
    return static_cast<std::size_t>(hash);
  }
};

FloatPoint PointAt(vtkDataSet* dataset, vtkIdType point)
{
  std::array<double, 3> place;
  dataset->GetPoint(point, place.data());
  FloatPoint rounded;
  for (int k = 0; k < 3; ++k)
  {
    rounded[k] = static_cast<float>(place[k]);
  }
  return rounded;
}

/// The points of the surface where those of the lines are.
class PointsOfLines
{
public:
  PointsOfLines(vtkDataSet* lines, vtkDataSet* surface)
    : Lines(lines)
    , Surface(surface)
    , AreShared(HaveSamePoints(vtkPointSet::SafeDownCast(lines), vtkPointSet::SafeDownCast(surface)))
  {
  }

  /// -1 where there is none.
  vtkIdType OnSurface(vtkIdType point)
  {
    if (this->AreShared)
    {
      return point;
    }
    const FloatPoint place = PointAt(this->Lines, point);
    if (point < this->Surface->GetNumberOfPoints() && PointAt(this->Surface, point) == place)
    {
      return point;
    }
    if (this->Places.empty())
    {
      for (vtkIdType each = 0; each < this->Surface->GetNumberOfPoints(); ++each)
      {
        this->Places.emplace(PointAt(this->Surface, each), each); // the first of those that coincide
      }
    }
    const auto found = this->Places.find(place);
    return found == this->Places.end() ? -1 : found->second;
  }

private:
  static bool HaveSamePoints(vtkPointSet* a, vtkPointSet* b) { return a && b && a->GetPoints() == b->GetPoints(); }

  vtkDataSet* const Lines;
  vtkDataSet* const Surface;
  const bool AreShared;
  std::unordered_map<FloatPoint, vtkIdType, HashOfPoint> Places; ///< as soon as numbers differ
};

/// A 1-form on the edges of a mesh that lines fill.
class FormOfLines
{
public:
  explicit FormOfLines(const FramedSurface& surface)
    : Mesh(surface.Geometry.Mesh)
    , Relation(surface.Relation)
    , Form(Vector<double>::Zero(Mesh.NumberOfEdges()))
    , IsKnown(Mesh.NumberOfEdges(), 0)
  {
  }

  /// Calls visit(halfedge) for the edges between two points, with a halfedge of each.
  template <class Visit>
  void VisitEdges(vtkIdType from, vtkIdType to, const Visit& visit) const
  {
    const ElementRow heads = this->Relation.VerticesOf(to);
    if (heads.empty())
    {
      return;
    }
    const int head = this->Relation.PointOf(heads.front());
    for (const int vertex : this->Relation.VerticesOf(from))
    {
      this->Mesh.VisitFan(vertex,
        [&](int h)
        {
          const int last = TriangleMesh::Previous(h); // it comes in; on a boundary no halfedge of the fan is its twin
          if (this->Relation.PointOf(this->Mesh.Head(h)) == head)
          {
            visit(h);
          }
          else if (this->Mesh.Twin(last) < 0 && this->Relation.PointOf(this->Mesh.Tail(last)) == head)
          {
            visit(last);
          }
        });
    }
  }

  /// \param value along the way from one of its vertices to the other. \return whether no other value has been set.
  bool Set(int halfedge, double valueAlong)
  {
    const int edge = this->Mesh.EdgeOf(halfedge);
    const double value = this->Mesh.EdgeSign(halfedge) * valueAlong;
    const bool isNew = !this->IsKnown[edge];
    this->Form[edge] = isNew ? value : this->Form[edge];
    this->IsKnown[edge] = 1;
    return isNew || this->Form[edge] == value;
  }

  /// \throw InvalidInput an edge has no value.
  const Vector<double>& Complete()
  {
    this->IsGiven = this->IsKnown;
    if (const int edge = FillDiagonals(this->Mesh, this->Relation, this->Form, this->IsKnown); edge >= 0)
    {
      const auto [a, b] = this->Mesh.EdgeVertices(edge);
      throw InvalidInput("no line of the edges joins points " + std::to_string(this->Relation.PointOf(a)) + " and " +
        std::to_string(this->Relation.PointOf(b)) +
        " of the surface; give each edge of the surface a line with its value, in the order of its points");
    }
    return this->Form;
  }

  /// Whether each edge has the value of a line, as it is no diagonal.
  const std::vector<char>& Given() const { return this->IsGiven; }

  const TriangleMesh& Mesh;
  const SurfaceRelation& Relation;

private:
  Vector<double> Form;
  std::vector<char> IsKnown;
  std::vector<char> IsGiven;
};

std::string NameOfLine(vtkIdType line)
{
  return "line " + std::to_string(line) + " of the edges";
}

}

FaceFlow FlowFromEdges(
  vtkDataSet* edges, const EdgeValues& values, const SurfaceView& view, const ExecutionContext& context)
{
  CheckCells(edges, "the dataset of edges");
  const ChosenArray choice{ values.Name, -1, vtkDataObject::FIELD_ASSOCIATION_CELLS };
  vtkDataArray* const array = FindArray(choice, edges, 1, "flow", "the edges").Array;
  if (!array)
  {
    throw InvalidInput("the edges are given, and no array of their lines is chosen for the flow; set Edge Array");
  }
  const FramedSurface surface = view.Surface();
  FormOfLines form(surface);
  PointsOfLines points(edges, view.Given());
  vtkNew<vtkIdList> ends;
  for (vtkIdType line = 0; line < edges->GetNumberOfCells(); ++line)
  {
    if (!IsLine(edges, line))
    {
      continue;
    }
    edges->GetCellPoints(line, ends);
    if (ends->GetNumberOfIds() != 2)
    {
      throw InvalidInput(NameOfLine(line) + " has " + std::to_string(ends->GetNumberOfIds()) +
        " points; give each edge of the surface a line of its own");
    }
    const vtkIdType from = points.OnSurface(ends->GetId(0));
    const vtkIdType to = points.OnSurface(ends->GetId(1));
    if (from < 0 || to < 0)
    {
      continue;
    }
    form.VisitEdges(from, to,
      [&](int h)
      {
        const TriangleMesh& mesh = form.Mesh;
        const bool isAlong =
          form.Relation.PointOf(mesh.Tail(h)) == form.Relation.PointOf(form.Relation.VerticesOf(from).front());
        const double value = array->GetComponent(line, 0) *
          (values.AreIntegrals ? 1.0 : (mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h))).norm());
        if (!std::isfinite(value))
        {
          throw InvalidInput("the flow is not finite on " + NameOfLine(line) +
            "; repair it, or take the cells beside it away with Threshold first");
        }
        if (!form.Set(h, isAlong ? value : -value))
        {
          throw InvalidInput(NameOfLine(line) + " joins the same points as another with another value; leave one out");
        }
      });
  }
  const Vector<double> integrals = form.Complete();
  FaceFlow flow{ FlowOfForm(surface.Geometry, integrals, context), {}, {} };
  flow.Derivatives = [surface, integrals, isGiven = form.Given()](const ExecutionContext& loops)
  { return DerivativesOfForm(surface.Geometry, surface.Relation, integrals, isGiven, loops); };
  return flow;
}

}
