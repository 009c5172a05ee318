#ifndef dmgGuideDataSets_h
#define dmgGuideDataSets_h

#include "Adapters/View/ChosenArrays.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkDataObject;

namespace dmg
{

/// A dataset of a guide, which may be composite.
struct GuideDataSet
{
  vtkSmartPointer<vtkDataSet> Data; ///< with numbered cells
  std::size_t Guide;                ///< number of its connection
  std::string Name;                 ///< for messages, as in "block 2 of guide 0"
};

/// The name of guide \p guide of several in messages.
/// \param kind what it is, in place of a guide.
std::string NameOfGuide(std::size_t guide, std::size_t guides, const std::string& kind = "guide");

/// Words for what an input takes, for messages.
struct InputWords
{
  std::string Kind = "guide";
  std::string Takes = "lines or points with vectors to Guides";
};

/// All datasets with points.
/// \throw InvalidInput a guide is neither a dataset nor composite.
std::vector<GuideDataSet> DataSetsOf(const std::vector<vtkDataObject*>& guides, const InputWords& words = {});

bool IsLine(vtkDataSet* dataset, vtkIdType cell);
bool HasLines(vtkDataSet* dataset);

/// \throw InvalidInput there is no such point, or it is not finite.
Vector3 PositionOf(const GuideDataSet& dataset, vtkIdType point);

/// \throw InvalidInput something is chosen that no dataset has.
void CheckChoices(const ConstraintArrays& choices, const std::vector<GuideDataSet>& datasets);

/// The numbers that are typed in place of the name of an array of weights, as in "5" or "1 0.5". Empty where it is a name, or a
/// dataset has an array of that name.
std::vector<double> TypedNumbers(const ChosenArray& choice, const std::vector<GuideDataSet>& datasets);

/// \param numbers TypedNumbers.
/// \param slots the place of each guide's number.
/// \return a weight for each guide: one number is that of all guides, and guides without a number have 1. Empty without numbers.
/// \throw InvalidInput a weight is negative or not finite.
std::vector<double> TypedWeights(const std::vector<double>& numbers, const std::vector<int>& slots);

/// The choices, as far as a dataset has their arrays.
ConstraintArrays ChoicesFor(const ConstraintArrays& choices, vtkDataSet* dataset);

/// The weight of a whole dataset: 1, unless one in its field data is chosen.
/// \throw InvalidInput it is negative or not finite.
double WholeWeight(const ChosenArray& choice, const GuideDataSet& dataset);

/// Mask and weights along lines that are followed themselves.
class LineArrays
{
public:
  /// \throw InvalidInput as FindArray.
  LineArrays(const ConstraintArrays& choices, const GuideDataSet& dataset);

  /// The weight of a segment between two points of a cell; 0: it is not followed.
  /// \throw InvalidInput it is negative or not finite.
  double Weight(vtkIdType cell, vtkIdType start, vtkIdType end) const;

private:
  ChosenArray Mask, Weights;
  std::string Name;
};

}

#endif
