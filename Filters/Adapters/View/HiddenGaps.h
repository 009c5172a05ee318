#ifndef dmgHiddenGaps_h
#define dmgHiddenGaps_h

#include "Adapters/View/SurfaceStep.h"
#include "Adapters/View/VectorArrays.h"

#include <string>
#include <vector>

namespace dmg
{

/// Arrays that are read together, of points or of cells.
struct ArraysWithGaps
{
  std::vector<vtkDataArray*> Arrays;
  bool AreOnPoints;
  std::string What; ///< their name in messages, as in "flow"
};

/// Hides the cells where numbers or vectors are not known, as on land: those with a number that is NaN, or with such a point. On the way
/// back, arrays are NaN on these cells and on those of their points that are not of the surface. Field data tell their number, as in
/// CellsWithoutFlow.
class HiddenGaps : public SurfaceStep
{
public:
  /// \param vectors of the dataset. \param what their name in messages, as in "flow".
  /// \throw InvalidInput all cells would be hidden; as SuspectedFillValues.
  HiddenGaps(vtkDataSet* dataset, const VectorArrays& vectors, const std::string& what);
  /// The same for an array that FindArray has found.
  HiddenGaps(vtkDataSet* dataset, const ChosenArray& numbers, const std::string& what);
  /// Hides the cells where one of several is not known. \param what their name together, for the report.
  HiddenGaps(vtkDataSet* dataset, const std::vector<ArraysWithGaps>& all, const std::string& what);
  /// Hides these cells, by cell, without a report. \pre not all of them.
  HiddenGaps(vtkDataSet* dataset, const std::vector<char>& isHidden);

  void ArrayBack(const AddedArray& array, const SurfaceRelation& relation) const override;
  void Report(vtkFieldData* fieldData) const override;
  /// A sentence about values that look like fill values.
  std::string Warning(const TriangleMesh&) const override { return this->Suspicion; }

private:
  HiddenGaps(vtkDataSet* dataset, const std::vector<vtkDataArray*>& arrays, bool areOnPoints, const std::string& what);
  void Hide(vtkDataSet* dataset, const std::vector<char>& isHidden);
  std::vector<vtkIdType> PointsBeside(const SurfaceRelation& relation) const;

  const std::string What;
  std::vector<vtkIdType> Cells; ///< that are hidden
  std::string Suspicion;
};

}

#endif
