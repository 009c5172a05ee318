#ifndef dmgSurfaceView_h
#define dmgSurfaceView_h

#include "Adapters/Surface/ElementArrays.h"
#include "Adapters/Surface/PreparedDataSet.h"
#include "Adapters/View/SurfaceStep.h"
#include "Adapters/View/VectorArrays.h"
#include "Adapters/View/VectorsOnSurface.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include "vtkSmartPointer.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

class vtkDataSet;
class vtkPolyData;

namespace dmg
{

/// A dataset as the surface that the core sees. On the way forth, the dataset goes through the steps that a filter takes, one after the other,
/// and through the repair (PrepareDataSet), which is the last one. On the way back, numbers of the core's elements become arrays of the
/// user's cells and points, and go through the steps in reverse: all that a filter writes has the user's numbers and coordinates.
///
/// The dataset has come through two steps before, whose results the outputs are of: volumes are their skin, and strips are triangles
/// (FilterOutputs.h). On ranks, pieces are gathered there.
class SurfaceView
{
public:
  explicit SurfaceView(vtkDataSet* given)
    : GivenData(given)
  {
  }

  /// Takes one more step, but for \p isTaken false. \param arguments of its constructor, after the dataset.
  template <class Step, class... Arguments>
  void TakeIf(bool isTaken, Arguments&&... arguments)
  {
    if (isTaken)
    {
      this->Steps.push_back(std::make_unique<const Step>(this->Data(), std::forward<Arguments>(arguments)...));
    }
  }

  /// Makes the dataset after all steps an oriented manifold.
  /// \throw InvalidInput as PrepareDataSet.
  void Prepare(const PreparationOptions& options, const ExecutionContext& context);
  /// Takes the surface that somebody has made of that dataset, and keeps longer than the view.
  void Prepare(const PreparationOptions& options, const FramedSurface& surface, const PreparationReport& report);

  /// The user's dataset.
  vtkDataSet* Given() const { return this->GivenData; }
  /// The dataset after all steps, with the cells and points of the user's.
  vtkDataSet* Data() const { return this->Steps.empty() ? this->GivenData.Get() : this->Steps.back()->Data(); }

  /// \pre Prepare; so all others.
  const FramedSurface& Surface() const { return *this->Framed; }
  const TriangleMesh& Mesh() const { return this->Framed->Geometry.Mesh; }
  const SurfaceRelation& Relation() const { return this->Framed->Relation; }
  /// The changes that made the surface a mesh.
  const PreparationReport& Repair() const { return this->Report; }
  /// The surface, to be kept. \pre it was prepared here.
  const std::shared_ptr<const PreparedDataSet>& Prepared() const { return this->Kept; }

  /// A place in the user's coordinates, as one of another dataset, in those of the surface.
  Vector3 PlaceForth(Vector3 place) const;

  /// The vectors of arrays of the user's dataset. At a pole they are the mean of the neighbours. Where points of several vectors were joined, the
  /// corners of each face have those of its own cell, and the vertex has their mean.
  /// \throw WrongChoice vectors of 2 numbers, and the surface is not in a plane of constant z; components, and it is.
  VectorsOnSurface Vectors(const VectorArrays& arrays) const;

  /// The numbers of an array of the user's dataset, by vertex or by face. Where points of several numbers were joined, their mean.
  Vector<double> Numbers(const ChosenArray& array) const;

  /// Makes \p output a copy of the user's dataset, to which arrays are added, and reports there what steps and repair have done.
  /// \param filter the class of the filter, whose arrays (OutputTable) a former execution may have left there: they are not copied.
  void StartOutput(vtkDataSet* output, const std::string& filter = "");
  vtkDataSet* Output() const { return this->OutputData; }
  /// The arrays of the user's cells and points. \param elsewhere the number where these are no elements of the surface.
  /// \pre StartOutput.
  ArraysOfCells OfCells(const ExecutionContext& context, double elsewhere = 0.0) const;
  ArraysOfPoints OfPoints(const ExecutionContext& context, double elsewhere = 0.0) const;

  /// Takes lines on the surface to the user's coordinates.
  void LinesBack(vtkPolyData* lines) const;
  /// The warnings of the steps.
  std::vector<std::string> Warnings() const;

private:
  Vector3 VectorForth(const VectorArrays& arrays, vtkIdType tuple, const Vector3& place) const;
  bool IsPole(const Vector3& place) const;
  bool IsFromPlane() const;
  Points PlacesOfCells(const Points& centres) const;
  ArrayChange WayBack() const;

  const vtkSmartPointer<vtkDataSet> GivenData;
  std::vector<std::unique_ptr<const SurfaceStep>> Steps;
  PreparationOptions Options;
  std::shared_ptr<const PreparedDataSet> Kept;
  std::optional<FramedSurface> Framed;
  PreparationReport Report;
  vtkDataSet* OutputData = nullptr;
};

}

#endif
