within Modelica.Mechanics.MultiBody.Interfaces;
partial model PartialVisualizer "Component that is only shown"
  Interfaces.Frame_a frame_a "Frame the shape is fixed to"
    annotation (Placement(transformation(extent={{-116,-16},{-84,16}})));
protected
  outer Modelica.Mechanics.MultiBody.World world;
  annotation (Documentation(info="<html><p>Base class of shapes for an animation.</p></html>"));
end PartialVisualizer;
