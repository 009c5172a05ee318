#ifndef ColorsAroundZero_h
#define ColorsAroundZero_h

class vtkSMProxy;
class vtkSMSourceProxy;

/// The colours of an array, as the initialization helpers of its filters set them.
struct ColorsAroundZero
{
  const char* Array;
  const char* Preset; ///< null for the one that ParaView has chosen
  /// Half the length of the interval that the data of the last update need; 0 leaves it as it is.
  double (*HalfOf)(vtkSMSourceProxy* filter);
  /// Whether the interval never shrinks, so that the steps of a time series have the same colours.
  bool OnlyGrows;
  const char* BarTitle;   ///< what stands beside a bar of these colours: the word and the unit
  const char* BarNumbers; ///< how printf writes its numbers
};

/// Gives a new filter its colours. Colours that somebody has chosen for arrays of this name stay.
void SetColorsAroundZero(vtkSMProxy* filter, const ColorsAroundZero& colors);

/// Fits the interval of these colours after each update of a filter, also of one from a state file. An interval that somebody has changed is
/// never touched again. A new bar of these colours says what its numbers are.
/// \param colors has to live as long as the filter.
void FitColorsAroundZero(vtkSMProxy* filter, const ColorsAroundZero& colors);

#endif
