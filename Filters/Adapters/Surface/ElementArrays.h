#ifndef dmgElementArrays_h
#define dmgElementArrays_h

#include "Adapters/Surface/ArrayNames.h"
#include "Adapters/Surface/MeshFromDataSet.h"
#include "Adapters/Surface/NewArrays.h"
#include "Directions/PowerFieldDirections.h"
#include "Mesh/TangentFrames.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include "vtkDataSet.h"
#include "vtkFieldData.h"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace dmg
{

/// An array that was added to a dataset.
struct AddedArray
{
  vtkDataArray* Array;
  bool IsOfPoints; ///< else of cells
  bool AreVectors; ///< in the coordinates of the surface, rather than numbers
};

/// A function that each array goes through once it is filled; it may be empty.
using ArrayChange = std::function<void(const AddedArray&)>;

/// Arrays with a tuple for each cell or point of the surface; where these are no elements of the mesh, zero or another number.
class ArraysOfElements
{
protected:
  static constexpr int Grain = 8192;

  ArraysOfElements(vtkFieldData* data, bool areOfPoints, vtkIdType tuples, const ExecutionContext& context,
    double elsewhere, ArrayChange change)
    : Data(data)
    , AreOfPoints(areOfPoints)
    , Tuples(static_cast<int>(tuples)) // MeshFromDataSet has seen to it
    , Context(context)
    , Elsewhere(elsewhere)
    , Change(std::move(change))
  {
  }

  double* NewTuples(const std::string& name, int components) const
  {
    const auto array = NewArray(name, components, this->Tuples);
    this->Data->AddArray(array);
    return array->GetPointer(0);
  }

  std::vector<double*> NewDirections(int number) const
  {
    std::vector<double*> tuples;
    for (int k = 0; k < number; ++k)
    {
      tuples.push_back(this->NewTuples(ArrayNames::Direction(k), 3));
    }
    return tuples;
  }

  /// Calls the change of a filled array.
  void Finish(const std::string& name, bool areVectors) const
  {
    if (this->Change)
    {
      this->Change({ this->Data->GetArray(name.c_str()), this->AreOfPoints, areVectors });
    }
  }

  void FinishDirections(int number) const
  {
    for (int k = 0; k < number; ++k)
    {
      this->Finish(ArrayNames::Direction(k), true);
    }
  }

  /// Vectors of a field in frames.
  Points InSpace(const TangentFrames& frames, const Vector<Complex>& field) const;

  /// Calls write(tuple, row of its elements) in the order of the elements, which are neighbours in memory where they are neighbours
  /// on the surface. \pre tuples and elements are one to one.
  template <class TupleOf, class Write>
  void ForElements(const TupleOf& tupleOf, const Write& write) const
  {
    this->Context.ParallelFor(0, this->Tuples, Grain,
      [&](int first, int last)
      {
        for (int element = first; element < last; ++element)
        {
          write(static_cast<vtkIdType>(tupleOf(element)), ElementRow{ &element, &element + 1 });
        }
      });
  }

  /// Calls write(tuple, row of its elements) in the order of the tuples, and fills tuples without elements.
  template <class RowOf, class Write>
  void ForTuples(const std::vector<double*>& arrays, int components, const RowOf& rowOf, const Write& write) const
  {
    this->Context.ParallelFor(0, this->Tuples, Grain,
      [&](int first, int last)
      {
        for (int tuple = first; tuple < last; ++tuple)
        {
          if (const ElementRow row = rowOf(tuple); !row.empty())
          {
            write(static_cast<vtkIdType>(tuple), row);
            continue;
          }
          for (double* const array : arrays)
          {
            std::fill_n(array + static_cast<vtkIdType>(components) * tuple, components, this->Elsewhere);
          }
        }
      });
  }

  vtkFieldData* const Data;
  const bool AreOfPoints;
  const int Tuples;
  const ExecutionContext& Context;
  const double Elsewhere; ///< where there are no elements
  const ArrayChange Change;
};

/// Arrays of cells. A cell of several faces has the mean of theirs, by area.
class ArraysOfCells : public ArraysOfElements
{
public:
  ArraysOfCells(const TriangleMesh& mesh, const SurfaceRelation& surface, vtkDataSet* input, vtkFieldData* data,
    const ExecutionContext& context, double elsewhere = 0.0, ArrayChange change = {})
    : ArraysOfElements(data, false, input->GetNumberOfCells(), context, elsewhere, std::move(change))
    , Mesh(mesh)
    , Surface(surface)
  {
  }

  /// \param values of each face, one after the other.
  void Add(const std::string& name, int components, const double* values) const
  {
    this->Write(name, components, values);
    this->Finish(name, false);
  }

  /// Adds a vector in space of each face. \param values three numbers for each, one after the other.
  void AddVectors(const std::string& name, const double* values) const
  {
    this->Write(name, 3, values);
    this->Finish(name, true);
  }

  /// Adds a tangent vector of each face.
  void AddVectors(const std::string& name, const TangentFrames& frames, const Vector<Complex>& field) const
  {
    this->AddVectors(name, this->InSpace(frames, field).data());
  }

  /// Adds numbers that are summed over a surface: a cell has the sum of those of its faces, and none of a twin's.
  void AddSums(const std::string& name, const double* values) const;

  /// Adds numbers that have no mean; a cell has that of its largest face.
  void AddOfLargest(const std::string& name, const double* values) const;

  /// A signless direction of each face, N of them 2 pi / N apart, with unit length where it is not zero. See CellDirections.
  void AddDirection(
    const std::string& name, const TangentFrames& frames, const Vector<Complex>& directions, int N) const;

  /// N-th powers, a complex number for each face in its frame. A cell of several faces has the power of its direction in
  /// its own plane; see CellDirections.
  /// \param first directions of these powers.
  void AddPowers(const std::string& name, const TangentFrames& frames, const double* powers,
    const Vector<Complex>& first, int N) const;

  /// Directions that \p vectors visits; see CellDirections.
  void AddDirections(
    const TangentFrames& frames, const Vector<Complex>& firstDirections, const DirectionVectors& vectors) const;

private:
  template <class WriteRow>
  void ForCells(const std::vector<double*>& arrays, int components, const WriteRow& write) const;
  void Write(const std::string& name, int components, const double* values) const;
  void WriteDirections(const std::vector<double*>& arrays, const TangentFrames& frames,
    const Vector<Complex>& directions, int N, const DirectionVectors& vectors) const;

  const TriangleMesh& Mesh;
  const SurfaceRelation& Surface;
};

/// Arrays of points. A point where sheets were parted has the values of its first vertex.
class ArraysOfPoints : public ArraysOfElements
{
public:
  ArraysOfPoints(const SurfaceRelation& surface, vtkDataSet* input, vtkFieldData* data, const ExecutionContext& context,
    double elsewhere = 0.0, ArrayChange change = {})
    : ArraysOfElements(data, true, input->GetNumberOfPoints(), context, elsewhere, std::move(change))
    , Surface(surface)
  {
  }

  /// \param values of each vertex, one after the other.
  void Add(const std::string& name, int components, const double* values) const
  {
    this->Write(name, components, values);
    this->Finish(name, false);
  }

  /// Adds a vector in space of each vertex. \param values three numbers for each, one after the other.
  void AddVectors(const std::string& name, const double* values) const
  {
    this->Write(name, 3, values);
    this->Finish(name, true);
  }

  /// Adds a tangent vector of each vertex.
  void AddVectors(const std::string& name, const TangentFrames& frames, const Vector<Complex>& field) const
  {
    this->AddVectors(name, this->InSpace(frames, field).data());
  }

  /// A number that is summed over a surface: a point has the sum of those of its vertices, and of points that were joined
  /// the first one has it.
  void AddSums(const std::string& name, const double* values) const;

  /// Directions that \p vectors visits.
  void AddDirections(
    const TangentFrames& frames, const Vector<Complex>& firstDirections, const DirectionVectors& vectors) const;

private:
  template <class WriteRow>
  void ForPoints(const std::vector<double*>& arrays, int components, const WriteRow& write) const;
  void Write(const std::string& name, int components, const double* values) const;

  const SurfaceRelation& Surface;
};

/// Adds an array of the lines of edges: of numbers that change their sign with the edge's orientation, one per
/// edge of the mesh.
void AddOnEdges(const TriangleMesh& mesh, const SurfaceRelation& surface, const std::string& name,
  const Vector<double>& values, vtkFieldData* data, const ExecutionContext& context);

}

#endif
