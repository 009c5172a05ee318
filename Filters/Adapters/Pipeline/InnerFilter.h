#ifndef dmgInnerFilter_h
#define dmgInnerFilter_h

#include "Support/ExecutionContext.h"

class vtkAlgorithm;

namespace dmg
{

/// Runs a filter that another one has made for itself. Its progress is that of \p context, and a request to abort the outer
/// one ends it. Its warnings are warnings of the outer filter, and so are its errors, since that one has results of its own.
/// \param piece, pieces that it is asked for.
/// \return whether the inner filter reported no error.
/// \throw Cancelled
bool UpdateInside(
  vtkAlgorithm* outer, vtkAlgorithm* inner, const ExecutionContext& context, int piece = 0, int pieces = 1);

}

#endif
