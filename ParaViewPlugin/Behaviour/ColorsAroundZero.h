#ifndef ColorsAroundZero_h
#define ColorsAroundZero_h

class vtkSMProxy;
class vtkSMSourceProxy;

/// The colours of an array, as the initialization helpers of its filters set them.
struct ColorsAroundZero
{
  const char* Array;
  const char* Preset; ///< null for the one that ParaView has chosen
  /// Half the length of the interval that the colours span, asked after each update of the filter; 0 leaves it as it is.
  double (*HalfOf)(vtkSMSourceProxy* filter);
};

/// Lets the colours span an interval around zero after each update of a filter. Colours that somebody has chosen for arrays of this name
/// stay.
/// \param colors has to live as long as the filter.
void SetColorsAroundZero(vtkSMProxy* filter, const ColorsAroundZero& colors);

#endif
