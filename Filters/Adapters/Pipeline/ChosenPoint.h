#ifndef dmgChosenPoint_h
#define dmgChosenPoint_h

#include "Support/Types.h"

class vtkAlgorithm;

namespace dmg
{

/// The point of a surface that a filter works from, as a property that tells it after an execution: that of the surface, or NaN where the
/// filter had none, or several, one for each leaf of a composite dataset.
class ChosenPoint
{
public:
  /// \param position of the property; borrowed, as the filter is.
  ChosenPoint(vtkAlgorithm* filter, double position[3]);

  /// Adds the point of a leaf, or of a dataset by itself.
  void Add(const Vector3& position);

  /// Whether the dataset of this execution is a leaf of a composite one.
  bool IsInLeaf() const { return this->OpenExecutions > 1; }

private:
  /// The executions of leaves begin and end within that of their composite dataset.
  void BeginExecution();
  void EndExecution();
  void Forget();

  double* const Position;
  int Number = 0; ///< of points in this execution
  int OpenExecutions = 0;
};

}

#endif
