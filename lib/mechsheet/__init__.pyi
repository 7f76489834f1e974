"""The public names and where they are defined; `mechsheet` loads each on its first use."""

from mechsheet.accuracy.extreme import (
    DigitsKept as DigitsKept,
)
from mechsheet.accuracy.extreme import (
    measured_scenes as measured_scenes,
)
from mechsheet.accuracy.jobs import (
    accuracy_jobs as accuracy_jobs,
)
from mechsheet.accuracy.jobs import (
    batch_times as batch_times,
)
from mechsheet.accuracy.precision import (
    WorkPrecision as WorkPrecision,
)
from mechsheet.accuracy.whole import (
    asked_costs as asked_costs,
)
from mechsheet.accuracy.whole import (
    whole_worksheets as whole_worksheets,
)
from mechsheet.mechanics.crank import (
    crank as crank,
)
from mechsheet.mechanics.crank import (
    rpr_crank_reach as rpr_crank_reach,
)
from mechsheet.mechanics.crank import (
    rrp_crank_reach as rrp_crank_reach,
)
from mechsheet.mechanics.crank import (
    rrr_crank_reach as rrr_crank_reach,
)
from mechsheet.mechanics.drive import (
    coupling_drive as coupling_drive,
)
from mechsheet.mechanics.drive import (
    cylinder_drive as cylinder_drive,
)
from mechsheet.mechanics.drive import (
    gear_drive as gear_drive,
)
from mechsheet.mechanics.equilibrium import (
    DriveMoment as DriveMoment,
)
from mechsheet.mechanics.equilibrium import (
    PinReaction as PinReaction,
)
from mechsheet.mechanics.equilibrium import (
    SlideReaction as SlideReaction,
)
from mechsheet.mechanics.equilibrium import (
    left_over as left_over,
)
from mechsheet.mechanics.equilibrium import (
    magnitudes as magnitudes,
)
from mechsheet.mechanics.equilibrium import (
    solve_reactions as solve_reactions,
)
from mechsheet.mechanics.joint import (
    bending as bending,
)
from mechsheet.mechanics.joint import (
    circular_joint as circular_joint,
)
from mechsheet.mechanics.joint import (
    neutral_axis as neutral_axis,
)
from mechsheet.mechanics.joint import (
    sum_of_elements as sum_of_elements,
)
from mechsheet.mechanics.load import (
    Load as Load,
)
from mechsheet.mechanics.load import (
    inertia as inertia,
)
from mechsheet.mechanics.planar import (
    angle as angle,
)
from mechsheet.mechanics.planar import (
    angle_between as angle_between,
)
from mechsheet.mechanics.planar import (
    angle_opposite as angle_opposite,
)
from mechsheet.mechanics.planar import (
    cross as cross,
)
from mechsheet.mechanics.planar import (
    dot as dot,
)
from mechsheet.mechanics.planar import (
    link_acceleration as link_acceleration,
)
from mechsheet.mechanics.planar import (
    link_point as link_point,
)
from mechsheet.mechanics.planar import (
    link_velocity as link_velocity,
)
from mechsheet.mechanics.planar import (
    product as product,
)
from mechsheet.mechanics.planar import (
    triangle_area as triangle_area,
)
from mechsheet.mechanics.prp import (
    PRPGroup as PRPGroup,
)
from mechsheet.mechanics.prp import (
    prp as prp,
)
from mechsheet.mechanics.prp import (
    prp_acceleration as prp_acceleration,
)
from mechsheet.mechanics.prp import (
    prp_condition as prp_condition,
)
from mechsheet.mechanics.prp import (
    prp_determinant as prp_determinant,
)
from mechsheet.mechanics.prp import (
    prp_reactions as prp_reactions,
)
from mechsheet.mechanics.prp import (
    prp_transmission_angle as prp_transmission_angle,
)
from mechsheet.mechanics.prp import (
    prp_velocity as prp_velocity,
)
from mechsheet.mechanics.rpp import (
    RPPGroup as RPPGroup,
)
from mechsheet.mechanics.rpp import (
    rpp as rpp,
)
from mechsheet.mechanics.rpp import (
    rpp_acceleration as rpp_acceleration,
)
from mechsheet.mechanics.rpp import (
    rpp_condition as rpp_condition,
)
from mechsheet.mechanics.rpp import (
    rpp_determinant as rpp_determinant,
)
from mechsheet.mechanics.rpp import (
    rpp_reactions as rpp_reactions,
)
from mechsheet.mechanics.rpp import (
    rpp_transmission_angle as rpp_transmission_angle,
)
from mechsheet.mechanics.rpp import (
    rpp_velocity as rpp_velocity,
)
from mechsheet.mechanics.rpr import (
    RPRGroup as RPRGroup,
)
from mechsheet.mechanics.rpr import (
    rpr as rpr,
)
from mechsheet.mechanics.rpr import (
    rpr_acceleration as rpr_acceleration,
)
from mechsheet.mechanics.rpr import (
    rpr_condition as rpr_condition,
)
from mechsheet.mechanics.rpr import (
    rpr_determinant as rpr_determinant,
)
from mechsheet.mechanics.rpr import (
    rpr_reach as rpr_reach,
)
from mechsheet.mechanics.rpr import (
    rpr_reactions as rpr_reactions,
)
from mechsheet.mechanics.rpr import (
    rpr_transmission_angle as rpr_transmission_angle,
)
from mechsheet.mechanics.rpr import (
    rpr_velocity as rpr_velocity,
)
from mechsheet.mechanics.rrp import (
    RRPGroup as RRPGroup,
)
from mechsheet.mechanics.rrp import (
    rrp as rrp,
)
from mechsheet.mechanics.rrp import (
    rrp_acceleration as rrp_acceleration,
)
from mechsheet.mechanics.rrp import (
    rrp_condition as rrp_condition,
)
from mechsheet.mechanics.rrp import (
    rrp_determinant as rrp_determinant,
)
from mechsheet.mechanics.rrp import (
    rrp_reach as rrp_reach,
)
from mechsheet.mechanics.rrp import (
    rrp_reactions as rrp_reactions,
)
from mechsheet.mechanics.rrp import (
    rrp_transmission_angle as rrp_transmission_angle,
)
from mechsheet.mechanics.rrp import (
    rrp_velocity as rrp_velocity,
)
from mechsheet.mechanics.rrr import (
    RRRGroup as RRRGroup,
)
from mechsheet.mechanics.rrr import (
    rrr as rrr,
)
from mechsheet.mechanics.rrr import (
    rrr_acceleration as rrr_acceleration,
)
from mechsheet.mechanics.rrr import (
    rrr_condition as rrr_condition,
)
from mechsheet.mechanics.rrr import (
    rrr_determinant as rrr_determinant,
)
from mechsheet.mechanics.rrr import (
    rrr_reach as rrr_reach,
)
from mechsheet.mechanics.rrr import (
    rrr_reactions as rrr_reactions,
)
from mechsheet.mechanics.rrr import (
    rrr_transmission_angle as rrr_transmission_angle,
)
from mechsheet.mechanics.rrr import (
    rrr_velocity as rrr_velocity,
)
from mechsheet.page.title import (
    title_block as title_block,
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
)
from mechsheet.studies.design import (
    Requirement as Requirement,
)
from mechsheet.studies.design import (
    pareto as pareto,
)
from mechsheet.studies.design import (
    save_scene as save_scene,
)
from mechsheet.studies.design import (
    scene_text as scene_text,
)
from mechsheet.studies.design import (
    search as search,
)
from mechsheet.studies.sensitivity import (
    sensitivity as sensitivity,
)
from mechsheet.studies.sweep import (
    Sweep as Sweep,
)
from mechsheet.studies.sweep import (
    grid as grid,
)
from mechsheet.studies.sweep import (
    sweep as sweep,
)
from mechsheet.studies.tolerance import (
    tolerance as tolerance,
)
from mechsheet.worksheet.cells import (
    evaluate as evaluate,
)
from mechsheet.worksheet.cells import (
    load as load,
)
from mechsheet.worksheet.cells import (
    results as results,
)
from mechsheet.worksheet.checks import (
    Check as Check,
)
from mechsheet.worksheet.checks import (
    assembled as assembled,
)
from mechsheet.worksheet.checks import (
    balance as balance,
)
from mechsheet.worksheet.checks import (
    check as check,
)
from mechsheet.worksheet.checks import (
    check_slope as check_slope,
)
from mechsheet.worksheet.checks import (
    closed_form as closed_form,
)
from mechsheet.worksheet.checks import (
    require as require,
)
from mechsheet.worksheet.checks import (
    summary as summary,
)
from mechsheet.worksheet.drawing import (
    Drawing as Drawing,
)
from mechsheet.worksheet.errors import (
    SheetError as SheetError,
)
from mechsheet.worksheet.errors import (
    refuse as refuse,
)
from mechsheet.worksheet.find import (
    Found as Found,
)
from mechsheet.worksheet.find import (
    find as find,
)
from mechsheet.worksheet.force_diagram import (
    cut_group as cut_group,
)
from mechsheet.worksheet.force_diagram import (
    largest_of as largest_of,
)
from mechsheet.worksheet.force_diagram import (
    polar as polar,
)
from mechsheet.worksheet.inputs import (
    Used as Used,
)
from mechsheet.worksheet.inputs import (
    declared as declared,
)
from mechsheet.worksheet.inputs import (
    inputs as inputs,
)
from mechsheet.worksheet.inputs import (
    read as read,
)
from mechsheet.worksheet.lines import (
    registry as registry,
)
from mechsheet.worksheet.lines import (
    typeset as typeset,
)
from mechsheet.worksheet.scene import (
    Limit as Limit,
)
from mechsheet.worksheet.table import (
    Column as Column,
)
from mechsheet.worksheet.table import (
    Figure as Figure,
)
from mechsheet.worksheet.table import (
    Table as Table,
)
from mechsheet.worksheet.table import (
    figure as figure,
)
from mechsheet.worksheet.table import (
    table as table,
)
from mechsheet.worksheet.title import (
    caption as caption,
)
from mechsheet.worksheet.title import (
    mark as mark,
)
from mechsheet.worksheet.title import (
    player as player,
)
from mechsheet.worksheet.title import (
    side_by_side as side_by_side,
)

__version__: str
