#ifndef dmgLineThroughRing_h
#define dmgLineThroughRing_h

#include "StructurePreserving/Decimation/OneRing.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// A place in a flattened one-ring after its collapse. It touches the sectors FirstSector to LastSector, in
/// turning order: one sector, or two at a corner x_k of the polygon, or all at the hub.
struct PlaceInRing
{
  Complex Place;
  int FirstSector;
  int LastSector;
  bool AtHub;

  bool Touches(int sector) const { return sector == this->FirstSector || sector == this->LastSector; }
};

/// The straight line between two places in a flattened one-ring: the sectors that it passes, and where it crosses
/// the spokes between them.
class LineThroughRing
{
public:
  /// \param ring borrowed. \param plane its vertices in the plane, by local numbers; borrowed.
  LineThroughRing(
    const OneRing& ring, const std::vector<Complex>& plane, const PlaceInRing& from, const PlaceInRing& to);

  int FirstSector() const { return this->First; }
  int NumberOfCrossings() const { return this->Crossings; }

  /// The crossing of the spoke between two sectors.
  struct Crossing
  {
    int Sector;      ///< that is entered
    int Leaving;     ///< halfedge of the sector that is left
    int Entering;    ///< its twin
    double Fraction; ///< of the crossing along Leaving
  };
  Crossing LeaveSector(int sector) const;

private:
  void TurnAroundHub(const PlaceInRing& from, const PlaceInRing& to);

  const OneRing& Ring;
  const std::vector<Complex>& Plane;
  const Complex From; ///< from the hub
  const Complex To;
  int First;
  int Crossings = 0;
  bool IsCounterClockwise = true;
};

}

#endif
