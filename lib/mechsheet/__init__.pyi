"""The public names and where they are defined; `mechsheet` loads each on its first use."""

# isort: skip_file
from mechsheet.accuracy.claims import claims_table as claims_table
from mechsheet.accuracy.conditioning import end_to_end as end_to_end
from mechsheet.accuracy.drawn import (
    group_times as group_times,
    random_groups as random_groups,
)
from mechsheet.accuracy.extreme import (
    measured_scenes as measured_scenes,
)
from mechsheet.accuracy.jobs import (
    accuracy_jobs as accuracy_jobs,
    batch_times as batch_times,
    cost_of_checks as cost_of_checks,
)
from mechsheet.accuracy.responses import integration_steps as integration_steps
from mechsheet.accuracy.studied import (
    study_costs as study_costs,
    study_jobs as study_jobs,
)
from mechsheet.accuracy.timing import (
    measured_on as measured_on,
    time_spread as time_spread,
)
from mechsheet.accuracy.whole import (
    asked_costs as asked_costs,
    whole_worksheets as whole_worksheets,
)
from mechsheet.document.error_chart import (
    DigitsKept as DigitsKept,
    WorkPrecision as WorkPrecision,
)
from mechsheet.mechanics.crank import (
    crank as crank,
    rpr_crank_reach as rpr_crank_reach,
    rrp_crank_reach as rrp_crank_reach,
    rrr_crank_reach as rrr_crank_reach,
)
from mechsheet.mechanics.drive import (
    coupling_drive as coupling_drive,
    cylinder_drive as cylinder_drive,
    gear_drive as gear_drive,
)
from mechsheet.mechanics.equilibrium import (
    DriveMoment as DriveMoment,
    PinReaction as PinReaction,
    SlideReaction as SlideReaction,
    left_over as left_over,
    magnitudes as magnitudes,
    solve_reactions as solve_reactions,
)
from mechsheet.mechanics.joint import (
    bending as bending,
    circular_joint as circular_joint,
    neutral_axis as neutral_axis,
    sum_of_elements as sum_of_elements,
)
from mechsheet.mechanics.load import (
    Load as Load,
    inertia as inertia,
)
from mechsheet.mechanics.planar import (
    angle as angle,
    angle_between as angle_between,
    angle_opposite as angle_opposite,
    cross as cross,
    dot as dot,
    link_acceleration as link_acceleration,
    link_point as link_point,
    link_velocity as link_velocity,
    product as product,
    triangle_area as triangle_area,
)
from mechsheet.mechanics.prp import (
    PRPGroup as PRPGroup,
    prp as prp,
    prp_acceleration as prp_acceleration,
    prp_condition as prp_condition,
    prp_determinant as prp_determinant,
    prp_reach as prp_reach,
    prp_reactions as prp_reactions,
    prp_transmission_angle as prp_transmission_angle,
    prp_velocity as prp_velocity,
)
from mechsheet.mechanics.rpp import (
    RPPGroup as RPPGroup,
    rpp as rpp,
    rpp_acceleration as rpp_acceleration,
    rpp_condition as rpp_condition,
    rpp_determinant as rpp_determinant,
    rpp_reach as rpp_reach,
    rpp_reactions as rpp_reactions,
    rpp_transmission_angle as rpp_transmission_angle,
    rpp_velocity as rpp_velocity,
)
from mechsheet.mechanics.rpr import (
    RPRGroup as RPRGroup,
    rpr as rpr,
    rpr_acceleration as rpr_acceleration,
    rpr_condition as rpr_condition,
    rpr_determinant as rpr_determinant,
    rpr_reach as rpr_reach,
    rpr_reactions as rpr_reactions,
    rpr_transmission_angle as rpr_transmission_angle,
    rpr_velocity as rpr_velocity,
)
from mechsheet.mechanics.rrp import (
    RRPGroup as RRPGroup,
    rrp as rrp,
    rrp_acceleration as rrp_acceleration,
    rrp_condition as rrp_condition,
    rrp_determinant as rrp_determinant,
    rrp_reach as rrp_reach,
    rrp_reactions as rrp_reactions,
    rrp_transmission_angle as rrp_transmission_angle,
    rrp_velocity as rrp_velocity,
)
from mechsheet.mechanics.rrr import (
    RRRGroup as RRRGroup,
    rrr as rrr,
    rrr_acceleration as rrr_acceleration,
    rrr_condition as rrr_condition,
    rrr_determinant as rrr_determinant,
    rrr_reach as rrr_reach,
    rrr_reactions as rrr_reactions,
    rrr_transmission_angle as rrr_transmission_angle,
    rrr_velocity as rrr_velocity,
)
from mechsheet.page.title import (
    title_block as title_block,
)
from mechsheet.recording.evaluation import (
    evaluate as evaluate,
)
from mechsheet.run.ask import (
    ask as ask,
)
from mechsheet.run.progress import (
    progress as progress,
)
from mechsheet.run.report import (
    export as export,
)
from mechsheet.studies.design import (
    Judged as Judged,
    Requirement as Requirement,
    pareto as pareto,
    save_scene as save_scene,
    scene_text as scene_text,
    search as search,
)
from mechsheet.studies.sensitivity import (
    sensitivity as sensitivity,
)
from mechsheet.studies.sweep import (
    Sweep as Sweep,
    grid as grid,
    sweep as sweep,
)
from mechsheet.studies.tolerance import (
    tolerance as tolerance,
)
from mechsheet.worksheet.balance import (
    balance as balance,
)
from mechsheet.worksheet.cells import (
    load as load,
    results as results,
)
from mechsheet.worksheet.check import (
    Check as Check,
    assembled as assembled,
    check as check,
    check_slope as check_slope,
    closed_form as closed_form,
    require as require,
    summary as summary,
)
from mechsheet.worksheet.drawing import (
    Drawing as Drawing,
)
from mechsheet.worksheet.errors import (
    SheetError as SheetError,
    refuse as refuse,
)
from mechsheet.worksheet.find import (
    Found as Found,
    find as find,
)
from mechsheet.worksheet.system import (
    Solution as Solution,
    minerr as minerr,
)
from mechsheet.worksheet.force_diagram import (
    cut_group as cut_group,
    largest_of as largest_of,
    polar as polar,
    polar_diagrams as polar_diagrams,
)
from mechsheet.worksheet.kinds import (
    one_of as one_of,
)
from mechsheet.worksheet.data_file import (
    from_file as from_file,
)
from mechsheet.worksheet.index import (
    index as index,
)
from mechsheet.worksheet.inputs import (
    Used as Used,
    declared as declared,
    inputs as inputs,
    read as read,
)
from mechsheet.worksheet.lines import (
    registry as registry,
)
from mechsheet.worksheet.scene import (
    Limit as Limit,
)
from mechsheet.worksheet.table import (
    Column as Column,
    Figure as Figure,
    Table as Table,
    figure as figure,
    table as table,
)
from mechsheet.worksheet.title import (
    caption as caption,
    mark as mark,
    player as player,
    side_by_side as side_by_side,
    slider as slider,
)
from mechsheet.worksheet.typeset import (
    typeset as typeset,
)

__version__: str
