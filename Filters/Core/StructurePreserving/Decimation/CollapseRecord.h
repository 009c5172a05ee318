#ifndef dmgCollapseRecord_h
#define dmgCollapseRecord_h

#include "StructurePreserving/Decimation/OneRing.h"

#include <vector>

namespace dmg
{

/// The record of an edge collapse, from which OverlayProlongation.h makes operators: the
/// faces that it replaced, and the plane in which those before and after it fill the same polygon.
struct CollapseRecord
{
  OneRing Ring;
  std::vector<Complex> Plane; ///< by the local numbers of the ring
};

}

#endif
