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

/// Hides the cells where vectors are not known, as on land: those with a number that is NaN, or with such a point. On the way back, arrays are
/// NaN on these cells and on those of their points that are not of the surface. Field data tell their number (CellsWithoutFlow).
class HiddenGaps : public SurfaceStep
{
public:
  /// \param vectors of the dataset. \param what their name in messages, as in "flow".
  /// \throw InvalidInput all cells would be hidden; as SuspectedFillValues.
  HiddenGaps(vtkDataSet* dataset, const VectorArrays& vectors, const std::string& what);
  /// Hides the cells where one of several is not known.
  HiddenGaps(vtkDataSet* dataset, const std::vector<ArraysWithGaps>& all);

  void ArrayBack(const AddedArray& array, const SurfaceRelation& relation) const override;
  void Report(vtkFieldData* fieldData) const override;
  /// A sentence about values that look like fill values.
  std::string Warning(const TriangleMesh&) const override { return this->Suspicion; }

private:
  std::vector<vtkIdType> PointsBeside(const SurfaceRelation& relation) const;

  std::vector<vtkIdType> Cells; ///< that are hidden
  std::string Suspicion;
};

}

#endif
