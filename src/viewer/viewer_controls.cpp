// The controls of a picture: overlay, handles, panels and notices, and what is done when they are used.
#include <memory>
#include <utility>

#include "scene_io/scene_io.h"
#include "viewer/strain_legend.h"
#include "viewer/viewer_facts.h"
#include "viewer/viewer_marks.h"
#include "viewer/viewer_program.h"

namespace clothsim {

void Viewer::drawControls() {
  const PictureArea area = pictureArea();
  drawMarks(mouse_.marks(mouseContext(), window_.cursor()));
  drawGizmos();
  const float neededByOthers = showKeys_ ? 66.0f : compare_.isOpen() ? 40.0f : 0.0f;  // em
  if (config_.showOverlay && area.width >= neededByOthers * em())
    drawFacts(viewerFacts(*open_, meter_, paused_, tempo_, refinedExposures(),
                          column_.measures().warnings(open_->scene())),
              area);
  if (showsPanels()) drawPanels();
  float noticeLift = timelineHeight();
  if (const std::optional<PaceAdvice> offered = advice(); offered && config_.showOverlay && !showKeys_) {
    const DrawnAdvice drawn = drawAdvice(*offered, tempo_, area, timelineHeight());
    requests_.remedy = drawn.pressed;
    noticeLift += drawn.height + 0.8f * em();
  }
  const SessionFacts now = open_->facts();
  requests_.timeline = drawTimeline({now.oldestFrame, now.frame, now.newestFrame, now.frameSinceStart,
                                     open_->frameSeconds(), paused_, tempo_, taker_.recordedSeconds()},
                                    area);
  if (config_.showOverlay && !showKeys_ && open_->scene().render.shader == "strain")
    drawStrainLegend(open_->scene().render, column_.measures().strainUnderCursor(), area, timelineHeight());
  compare_.draw(area);
  if (notice_.secondsLeft > 0) drawNotice(notice_.text, notice_.isError, area, noticeLift);
  if (showKeys_) drawKeyList(area);
  const bool wasOpen = std::exchange(dialogShown_, dialog_.isOpen());
  if (wasOpen && !dialog_.isOpen()) ui_.closePopups();
  requests_.file = dialog_.draw();
  if (dialog_.isOpen()) config_.folder = dialog_.folder().string();
}

// Clipped to the picture: what lies under the panels cannot be reached there.
void Viewer::drawGizmos() {
  const PictureArea area = pictureArea();
  ImGui::GetBackgroundDrawList()->PushClipRect({0, 0}, {area.width, area.height});
  const std::shared_ptr<void> unclip(nullptr, [](void*) { ImGui::GetBackgroundDrawList()->PopClipRect(); });
  const ViewerWindow::Cursor cursor = window_.cursor();
  const glm::vec2 place(cursor.x, cursor.y);
  const MouseContext context = mouseContext();
  mouse_.chosen().draw(context, isOverPicture(cursor) ? std::optional(place) : std::nullopt);
  if (!config_.showOverlay) return;
  drawAxes(open_->camera(), pictureArea());
  const bool isShown = mouse_.chosen().gizmo(context).has_value();
  drawGizmoButtons(pictureArea().width, isShown ? std::optional(mouse_.chosen().mode) : std::nullopt, place);
}

void Viewer::drawPanels() {
  if (!draftHeld_ && !waitingEdit_) draft_ = open_->scene();
  const glm::vec3 target = open_->camera().target();
  const std::string name = open_->name();
  const SessionFacts facts = open_->facts();
  PanelContext context{draft_,
                       widgets_,
                       facts,
                       open_->backend(),
                       open_->view,
                       {target.x, target.y, target.z},
                       name,
                       quality_,
                       mouse_.chosen().solid()};
  column_.draw(context, config_);
  requests_.edits = widgets_.takeEdits();
  requests_.panels = std::move(context.requests);
}

// Does what the controls of the last picture ask for.
void Viewer::applyRequests() {
  const ControlRequests asked = std::exchange(requests_, {});
  apply(asked.edits);
  // While a frame is simulated they wait for its end.
  const PanelRequests& panels = asked.panels;
  const TimelineRequests& timeline = asked.timeline;
  if (panels != PanelRequests{}) whenIdle([=, this] { apply(panels); });
  if (timeline != TimelineRequests{}) whenIdle([=, this] { apply(timeline); });
  if (timeline.slowMotion) atOnce([this] { act(ViewerAction::slowMotion); });
  if (asked.file) openChosen(*asked.file);
  if (asked.remedy) whenIdle([this, remedy = *asked.remedy] { apply(remedy); });
}

void Viewer::apply(const FieldEdits& edits) {
  draftHeld_ = edits.holding;
  const bool edited = edits.live || edits.rebuild;
  if (edits.rebuild && !attempt([&] { followGrids(draft_, waitingEdit_ ? *waitingEdit_ : open_->scene()); }))
    return static_cast<void>(draftHeld_ = false);
  if (edited && isStepping()) {
    waitingEdit_ = draft_;
  } else if (edited) {
    attempt([&] {
      draftHeld_ = false;  // after an impossible edit the panels show the scene as it is
      edit(draft_, editContinues_);
      draftHeld_ = edits.holding;
    });
  }
  editContinues_ = edits.holding && (editContinues_ || edited);
}

void Viewer::apply(const PanelRequests& requests) {
  attempt([&] {
    for (const ViewerAction action : requests.actions) act(action);
    if (requests.backend) switchBackend(*requests.backend);
    if (requests.quality) setQuality(*requests.quality);
    if (requests.saveSceneAs) saveSceneAs(*requests.saveSceneAs);
    if (requests.resetScene) {
      edit(*open_->loaded(), false);
      restart();
    }
    if (requests.startsAnew) startAnew();
    if (requests.saveCurves) saveCurves();
    if (requests.chooseSolid) mouse_.chosen().chooseSolid(*requests.chooseSolid);
    if (requests.openScene) sceneToOpen_ = requests.openScene;
  });
}

void Viewer::apply(const TimelineRequests& requests) {
  attempt([&] {
    if (requests.seek) seek(*requests.seek);
    if (requests.stepBack) act(ViewerAction::stepBack);
    if (requests.stepForward) act(ViewerAction::stepForward);
    if (requests.togglePause) act(ViewerAction::pause);
    if (requests.screenshot) act(ViewerAction::screenshot);
    if (requests.toggleRecording) act(ViewerAction::recordClip);
  });
}

}  // namespace clothsim
