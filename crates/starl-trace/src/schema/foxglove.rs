//! Foxglove's own schemas, as far as views use them: <https://docs.foxglove.dev/docs/sdk/schemas>. Members of entities
//! that are always empty here have the schema of an array without element type.

use super::{Member, always, array, boolean, number, object, root, string};

/// `foxglove.PoseInFrame`.
pub(crate) fn pose_in_frame() -> String {
    let members = [
        always("timestamp", time()),
        always("frame_id", string("frame of the pose")),
        always("pose", pose()),
    ];
    root("foxglove.PoseInFrame", "A pose at a time", &members)
}

/// `foxglove.FrameTransforms`.
pub(crate) fn frame_transforms() -> String {
    let transform = object(
        "\"title\":\"foxglove.FrameTransform\",",
        &[
            always("timestamp", time()),
            always("parent_frame_id", string("name of the parent frame")),
            always("child_frame_id", string("name of the child frame")),
            always("translation", vector()),
            always("rotation", quaternion()),
        ],
    );
    let members = [always("transforms", array(transform))];
    root(
        "foxglove.FrameTransforms",
        "Where frames are in their parents",
        &members,
    )
}

/// `foxglove.Log`.
pub(crate) fn log() -> String {
    let levels = ["UNKNOWN", "DEBUG", "INFO", "WARNING", "ERROR", "FATAL"];
    let members = [
        always("timestamp", time()),
        always("level", choice(&levels)),
        always("message", string("the line")),
        always("name", string("its author")),
        always("file", string("always empty")),
        always("line", "{\"type\":\"integer\",\"minimum\":0}"),
    ];
    root("foxglove.Log", "A line of a log", &members)
}

/// `foxglove.SceneUpdate`.
pub(crate) fn scene_update() -> String {
    let deletion = [
        always("timestamp", time()),
        always("type", choice(&["MATCHING_ID", "ALL"])),
        always("id", string("which entity")),
    ];
    let entity = [
        always("timestamp", time()),
        always("frame_id", string("frame of the entity")),
        always("id", string("replaces the entity that had it before")),
        always("lifetime", time()),
        always(
            "frame_locked",
            boolean("whether the entity moves with its frame"),
        ),
        always(
            "metadata",
            array(object(
                "",
                &[always("key", string("")), always("value", string(""))],
            )),
        ),
        always("arrows", array(object("", &[]))),
        always("cubes", array(object("", &cube()))),
        always("spheres", array(object("", &cube()))),
        always("cylinders", array(object("", &cylinder()))),
        always("lines", array(object("", &line()))),
        always("triangles", array(object("", &triangles()))),
        always("texts", array(object("", &text()))),
        always("models", array(object("", &[]))),
    ];
    let members = [
        always(
            "deletions",
            array(object(
                "\"title\":\"foxglove.SceneEntityDeletion\",",
                &deletion,
            )),
        ),
        always(
            "entities",
            array(object("\"title\":\"foxglove.SceneEntity\",", &entity)),
        ),
    ];
    root(
        "foxglove.SceneUpdate",
        "A change of the drawn scene",
        &members,
    )
}

fn cube() -> [Member<'static>; 3] {
    [
        always("pose", pose()),
        always("size", vector()),
        always("color", color()),
    ]
}

fn cylinder() -> [Member<'static>; 5] {
    [
        always("pose", pose()),
        always("size", vector()),
        always("bottom_scale", number("1 for a cylinder")),
        always("top_scale", number("1 for a cylinder")),
        always("color", color()),
    ]
}

fn line() -> [Member<'static>; 8] {
    [
        always("type", choice(&["LINE_STRIP", "LINE_LOOP", "LINE_LIST"])),
        always("pose", pose()),
        always("thickness", number("metres, or pixels if scale_invariant")),
        always(
            "scale_invariant",
            boolean("whether the thickness is in pixels"),
        ),
        always("points", array(vector())),
        always("color", color()),
        always("colors", array(color())),
        always(
            "indices",
            array("{\"type\":\"integer\",\"minimum\":0}".into()),
        ),
    ]
}

fn triangles() -> [Member<'static>; 5] {
    [
        always("pose", pose()),
        always("points", array(vector())),
        always("color", color()),
        always("colors", array(color())),
        always(
            "indices",
            array("{\"type\":\"integer\",\"minimum\":0}".into()),
        ),
    ]
}

fn text() -> [Member<'static>; 6] {
    [
        always("pose", pose()),
        always("billboard", boolean("whether it faces the camera")),
        always(
            "font_size",
            number("height of a line, metres, or pixels if scale_invariant"),
        ),
        always("scale_invariant", boolean("whether the size is in pixels")),
        always("color", color()),
        always("text", string("the text")),
    ]
}

fn time() -> String {
    object(
        "\"title\":\"time\",",
        &[
            always("sec", "{\"type\":\"integer\",\"minimum\":0}"),
            always(
                "nsec",
                "{\"type\":\"integer\",\"minimum\":0,\"maximum\":999999999}",
            ),
        ],
    )
}

fn vector() -> String {
    let axis = || number("metres");
    object(
        "",
        &[
            always("x", axis()),
            always("y", axis()),
            always("z", axis()),
        ],
    )
}

fn quaternion() -> String {
    let part = || "{\"type\":\"number\"}";
    object(
        "",
        &[
            always("x", part()),
            always("y", part()),
            always("z", part()),
            always("w", part()),
        ],
    )
}

fn pose() -> String {
    object(
        "",
        &[
            always("position", vector()),
            always("orientation", quaternion()),
        ],
    )
}

fn color() -> String {
    let part = || "{\"type\":\"number\",\"minimum\":0,\"maximum\":1}";
    object(
        "",
        &[
            always("r", part()),
            always("g", part()),
            always("b", part()),
            always("a", part()),
        ],
    )
}

/// One of a few numbered names.
fn choice(names: &[&str]) -> String {
    let alternatives: Vec<String> = (names.iter().enumerate())
        .map(|(number, name)| format!("{{\"title\":\"{name}\",\"const\":{number}}}"))
        .collect();
    format!("{{\"oneOf\":[{}]}}", alternatives.join(","))
}
