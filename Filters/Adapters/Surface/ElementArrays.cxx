#include "Adapters/Surface/ElementArrays.h"

#include "Directions/CellDirections.h"

#include <algorithm>

namespace dmg
{

template <class WriteRow>
void ArraysOfCells::ForCells(const std::vector<double*>& arrays, int components, const WriteRow& write) const
{
  this->Surface.IsOneToOne() && this->Surface.NumberOfFaces() == this->Tuples
    ? this->ForElements([this](int face) { return this->Surface.CellOf(face); }, write)
    : this->ForTuples(
        arrays, components, [this](int cell) { return this->Surface.FacesOf(cell); }, write);
}

void ArraysOfCells::Write(const std::string& name, int components, const double* values) const
{
  double* const tuples = this->NewTuples(name, components);
  const auto mean = [&](double* tuple, const ElementRow& faces)
  {
    std::fill_n(tuple, components, 0.0);
    const double smallest = 1e-12 * this->Mesh.FaceArea(LargestFace(this->Mesh, faces));
    double weights = 0.0;
    for (const int face : faces)
    {
      const double weight = smallest > 0.0 ? this->Mesh.FaceArea(face) : 1.0;
      weights += weight;
      for (int k = 0; k < components; ++k)
      {
        tuple[k] += weight * values[components * face + k];
      }
    }
    std::transform(tuple, tuple + components, tuple, [weights](double sum) { return sum / weights; });
  };
  this->ForCells({ tuples }, components,
    [&](vtkIdType cell, const ElementRow& faces)
    {
      if (faces.size() > 1)
      {
        mean(tuples + components * cell, faces);
        return;
      }
      std::copy_n(values + static_cast<vtkIdType>(components) * faces.front(), components, tuples + components * cell);
    });
}

void ArraysOfCells::AddSums(const std::string& name, const double* values) const
{
  double* const tuples = this->NewTuples(name, 1);
  this->ForCells({ tuples }, 1,
    [&](vtkIdType cell, const ElementRow& faces)
    {
      tuples[cell] = 0.0;
      for (const int face : faces)
      {
        tuples[cell] += this->Surface.CellOf(face) == cell ? values[face] : 0.0;
      }
    });
  this->Finish(name, false);
}

void ArraysOfCells::AddOfLargest(const std::string& name, const double* values) const
{
  double* const tuples = this->NewTuples(name, 1);
  this->ForCells({ tuples }, 1,
    [&](vtkIdType cell, const ElementRow& faces) { tuples[cell] = values[LargestFace(this->Mesh, faces)]; });
  this->Finish(name, false);
}

void ArraysOfCells::AddDirection(
  const std::string& name, const TangentFrames& frames, const Vector<Complex>& directions, int N) const
{
  this->WriteDirections({ this->NewTuples(name, 3) }, frames, directions, N, DirectionVectors(1, true, 1));
  this->Finish(name, true);
}

void ArraysOfCells::AddPowers(
  const std::string& name, const TangentFrames& frames, const double* powers, const Vector<Complex>& first, int N) const
{
  double* const tuples = this->NewTuples(name, 2);
  const CellDirections means(this->Mesh, frames, N);
  this->ForCells({ tuples }, 2,
    [&](vtkIdType cell, const ElementRow& faces)
    {
      if (faces.size() == 1)
      {
        std::copy_n(powers + 2 * static_cast<vtkIdType>(faces.front()), 2, tuples + 2 * cell);
        return;
      }
      const Complex mean = means.Mean(faces, first).First;
      const Complex power = std::polar(std::abs(mean), N * std::arg(mean));
      tuples[2 * cell] = power.real();
      tuples[2 * cell + 1] = power.imag();
    });
  this->Finish(name, false);
}

void ArraysOfCells::AddDirections(
  const TangentFrames& frames, const Vector<Complex>& firstDirections, const DirectionVectors& vectors) const
{
  this->WriteDirections(this->NewDirections(vectors.Visited), frames, firstDirections, vectors.N, vectors);
  this->FinishDirections(vectors.Visited);
}

void ArraysOfCells::WriteDirections(const std::vector<double*>& arrays, const TangentFrames& frames,
  const Vector<Complex>& directions, int N, const DirectionVectors& vectors) const
{
  const CellDirections means(this->Mesh, frames, N);
  this->ForCells(arrays, 3,
    [&](vtkIdType cell, const ElementRow& faces)
    {
      const auto write = [&](int k, const Vector3& vector) { std::copy_n(vector.data(), 3, arrays[k] + 3 * cell); };
      if (faces.size() > 1)
      {
        const CellDirections::Direction mean = means.Mean(faces, directions);
        vectors.VisitIn(mean.X, mean.Y, mean.First, write);
        return;
      }
      vectors.VisitAt(frames, faces.front(), directions[faces.front()], write);
    });
}

Points ArraysOfElements::InSpace(const TangentFrames& frames, const Vector<Complex>& field) const
{
  Points vectors(field.size(), 3);
  this->Context.ParallelFor(0, static_cast<int>(field.size()), Grain,
    [&](int first, int last)
    {
      for (int element = first; element < last; ++element)
      {
        vectors.row(element) = frames.ToVector(element, field[element]).transpose();
      }
    });
  return vectors;
}

template <class WriteRow>
void ArraysOfPoints::ForPoints(const std::vector<double*>& arrays, int components, const WriteRow& write) const
{
  this->Surface.IsOneToOne() && this->Surface.NumberOfVertices() == this->Tuples
    ? this->ForElements([this](int vertex) { return this->Surface.PointOf(vertex); }, write)
    : this->ForTuples(
        arrays, components, [this](int point) { return this->Surface.VerticesOf(point); }, write);
}

void ArraysOfPoints::Write(const std::string& name, int components, const double* values) const
{
  double* const tuples = this->NewTuples(name, components);
  this->ForPoints({ tuples }, components,
    [&](vtkIdType point, const ElementRow& vertices)
    {
      std::copy_n(
        values + static_cast<vtkIdType>(components) * vertices.front(), components, tuples + components * point);
    });
}

void ArraysOfPoints::AddSums(const std::string& name, const double* values) const
{
  double* const tuples = this->NewTuples(name, 1);
  this->ForPoints({ tuples }, 1,
    [&](vtkIdType point, const ElementRow& vertices)
    {
      tuples[point] = 0.0;
      for (const int vertex : vertices)
      {
        tuples[point] += this->Surface.PointOf(vertex) == point ? values[vertex] : 0.0;
      }
    });
  this->Finish(name, false);
}

void ArraysOfPoints::AddDirections(
  const TangentFrames& frames, const Vector<Complex>& firstDirections, const DirectionVectors& vectors) const
{
  const std::vector<double*> arrays = this->NewDirections(vectors.Visited);
  this->ForPoints(arrays, 3,
    [&](vtkIdType point, const ElementRow& vertices)
    {
      vectors.VisitAt(frames, vertices.front(), firstDirections[vertices.front()],
        [&](int k, const Vector3& vector) { std::copy_n(vector.data(), 3, arrays[k] + 3 * point); });
    });
  this->FinishDirections(vectors.Visited);
}

void AddOnEdges(const TriangleMesh& mesh, const SurfaceRelation& surface, const std::string& name,
  const Vector<double>& values, vtkFieldData* data, const ExecutionContext& context)
{
  constexpr int Grain = 8192;
  const int numberOfEdges = static_cast<int>(surface.Edges().size());
  const auto array = NewArray(name, 1, numberOfEdges);
  double* const tuples = array->GetPointer(0);
  context.ParallelFor(0, numberOfEdges, Grain,
    [&](int first, int last)
    {
      for (int line = first; line < last; ++line)
      {
        const int edge = surface.Edges()[line];
        tuples[line] = surface.EdgeSign(mesh, edge) * values[edge];
      }
    });
  data->AddArray(array);
}

}
