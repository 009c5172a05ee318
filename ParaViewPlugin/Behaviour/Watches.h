#ifndef Watches_h
#define Watches_h

class vtkSMProxy;

/// What filters of the plugin do beside their work in a session of ParaView. Each function adds observers to a filter whose XML asks for it
/// by a hint:
///
///   <Watch for="Followed" />
///
/// WatchFilters calls them however the filter has come into being. An InitializationHelper is for new filters alone: ParaView calls none
/// for those of a state file.

/// "Followed". After an update, one line in the output messages says what the field follows: the property Followed of the filter. It comes
/// again only where that has changed.
void WatchFollowed(vtkSMProxy* filter);

/// "Summary". The same for the property Summary of a filter, which says what it has made.
void WatchSummary(vtkSMProxy* filter);

/// "GuidesFirst". The button Apply goes through all proxies that have changed, in no order that a person would know, and a new filter is
/// updated as soon as its turn comes. Guides whose turn comes later have the values of their creation until then. Values that the panel
/// holds for the inputs of a filter's further ports are therefore taken over when the properties of the filter are, with what these inputs
/// are made of. The turn of the guides comes all the same, and changes nothing more.
void WatchGuidesFirst(vtkSMProxy* filter);

/// "GuidesOnce". The panel has a list for each guide, and each list offers all sources. Where somebody chooses a source in one list that
/// another list has chosen, the other list gives it up. A source that goes from list to list takes its number of Guide Weights with it, and
/// keeps its arrow in the pipeline. Lists are the inputs whose hints have the element ChosenOnce.
void WatchGuidesOnce(vtkSMProxy* filter);

/// "Boxes". A check box is on as long as a weight is not 0, and switches it on and off, in the panel as well as for scripts: a box on sets
/// the last weight there was, or 1. States and scripts that know weights alone set the box by these. A box is a property of one number
/// without a command, whose hints name the weight, as <Switches property="Boundary Weight" />.
void WatchBoxes(vtkSMProxy* filter);

/// "DeletedInputs". ParaView keeps a source alive that is deleted while a filter has it as an input: the panel no longer shows it, and the
/// filter goes on to use it. Scripts allow this, and windows with a state file of theirs. So sources that are deleted are taken out of the
/// inputs of the filter's further ports.
void WatchDeletedInputs(vtkSMProxy* filter);

/// "ChosenPoint". After an update in which a filter has chosen its point itself, as that of a logarithmic map, the property Point, and with it the
/// handle in the view, is at that point and stays there. Whoever sets Point before has chosen.
void WatchChosenPoint(vtkSMProxy* filter);

/// "CenteredColors". The colours of StreamFunction span the interval around zero that all updates of this filter have needed so far, unless
/// somebody changes it. Their bar has a title with the unit, and numbers of three digits.
void WatchCenteredColors(vtkSMProxy* filter);

/// "CyclicColors". The colours of Angle span the property Period around zero, unless somebody changes the interval. Their bar has a title with
/// the unit, and whole numbers.
void WatchCyclicColors(vtkSMProxy* filter);

/// Has the filters of all sessions watched, of this time and to come. The plugin calls it when it is loaded.
void WatchFilters();

#endif
