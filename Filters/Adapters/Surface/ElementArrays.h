#ifndef dmgElementArrays_h
#define dmgElementArrays_h

#include "Adapters/Surface/ArrayNames.h"
#include "Adapters/Surface/MeshFromPolyData.h"
#include "Mesh/TangentFrames.h"
#include "Operators/PowerFieldDirections.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace dmg
{

/// Its values are to be written.
vtkSmartPointer<vtkDoubleArray> NewArray(const std::string& name, int components, vtkIdType tuples);

/// Adds an array that no menu offers, as for colours (vtkAbstractArray::GUI_HIDE).
void AddHidden(vtkFieldData* fieldData, vtkAbstractArray* array);

/// Arrays of the cells or points of the surface: zeros where these are no elements of the mesh.
template <class ElementOf>
class ArraysOfElements
{
public:
  /// \param tuples of each array.
  /// \param elementOf the face or vertex of a tuple, or -1.
  ArraysOfElements(vtkFieldData* data, vtkIdType tuples, ElementOf elementOf, const ExecutionContext& context)
    : Data(data)
    , Tuples(static_cast<int>(tuples)) // MeshFromPolyData has seen to it
    , ElementOfTuple(std::move(elementOf))
    , Context(context)
  {
  }

  /// \param values of each element, one after the other.
  void Add(const std::string& name, int components, const double* values) const
  {
    double* const tuples = this->NewTuples(name, components);
    this->ForTuples([&](vtkIdType tuple, vtkIdType element)
      { std::copy_n(values + components * element, components, tuples + components * tuple); },
      [&](vtkIdType tuple) { std::fill_n(tuples + components * tuple, components, 0.0); });
  }

  void AddDirections(const TangentFrames& frames, const Vector<Complex>& firstDirections, int N, bool unitLength) const
  {
    std::vector<double*> tuples;
    for (int k = 0; k < N; ++k)
    {
      tuples.push_back(this->NewTuples(ArrayNames::Direction(k), 3));
    }
    const DirectionVectors vectors(N, unitLength);
    this->ForTuples(
      [&](vtkIdType tuple, int element)
      {
        vectors.VisitAt(frames, element, firstDirections[element],
          [&](int k, const Vector3& vector) { std::copy_n(vector.data(), 3, tuples[k] + 3 * tuple); });
      },
      [&](vtkIdType tuple)
      {
        for (double* const direction : tuples)
        {
          std::fill_n(direction + 3 * tuple, 3, 0.0);
        }
      });
  }

private:
  double* NewTuples(const std::string& name, int components) const
  {
    const auto array = NewArray(name, components, this->Tuples);
    this->Data->AddArray(array);
    return array->GetPointer(0);
  }

  /// Arrays are written from one end to the other: what they are made from is less.
  template <class OfElement, class OfNone>
  void ForTuples(const OfElement& ofElement, const OfNone& ofNone) const
  {
    constexpr int Grain = 8192;
    this->Context.ParallelFor(0, this->Tuples, Grain,
      [&](int first, int last)
      {
        for (int tuple = first; tuple < last; ++tuple)
        {
          if (const int element = this->ElementOfTuple(tuple); element >= 0)
          {
            ofElement(tuple, element);
          }
          else
          {
            ofNone(tuple);
          }
        }
      });
  }

  vtkFieldData* const Data;
  const int Tuples;
  const ElementOf ElementOfTuple;
  const ExecutionContext& Context;
};

inline auto ArraysOfCells(
  const SurfaceNumbering& surface, vtkPolyData* input, vtkFieldData* data, const ExecutionContext& context)
{
  return ArraysOfElements(
    data, input->GetNumberOfCells(), [&surface](vtkIdType cell) { return surface.FaceOf(cell); }, context);
}

inline auto ArraysOfPoints(
  const SurfaceNumbering& surface, vtkPolyData* input, vtkFieldData* data, const ExecutionContext& context)
{
  return ArraysOfElements(
    data, input->GetNumberOfPoints(), [&surface](vtkIdType point) { return surface.VertexOf(point); }, context);
}

/// Adds an array of the lines of edges: of numbers that change their sign with the edge's orientation, one per
/// edge of the mesh.
void AddOnEdges(const TriangleMesh& mesh, const SurfaceNumbering& surface, const std::string& name,
  const Vector<double>& values, vtkFieldData* data, const ExecutionContext& context);

}

#endif
