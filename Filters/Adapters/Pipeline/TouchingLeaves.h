#ifndef dmgTouchingLeaves_h
#define dmgTouchingLeaves_h

class vtkAlgorithm;
class vtkDataSet;

/// Leaves of a composite dataset whose boundaries lie on each other, as tiles of one surface. The pipeline hands them to a filter one after
/// the other, so that each is worked on by itself.
namespace dmg
{

/// Another execution of a filter begins.
/// \param isLeaf whether with a leaf of the dataset that the last one began with.
void BeginExecution(vtkAlgorithm* algorithm, bool isLeaf);

/// Whether a filter works on a leaf of a composite dataset.
bool IsOnLeaf(vtkAlgorithm* algorithm);

/// Warns, once for a composite dataset, where the boundary of a leaf lies on that of a former one. Leaves of the same bounds are not taken
/// for tiles. Does nothing where this is no leaf.
/// Cost: n log n in the number of its points.
void WarnOfTouchingLeaves(vtkAlgorithm* algorithm, vtkDataSet* surface);

}

#endif
